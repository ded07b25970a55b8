/* A law: a device under held inputs, with all that follows from these alone. */
#ifndef SLIDER_LAW_H
#define SLIDER_LAW_H

#include <stdbool.h>

#include "../base/refusal.h"
#include "../device/device.h"
#include "../device/fast_vibration.h"
#include "../device/held.h"
#include "bristle.h"
#include "friction_table.h"

/* The caches outlive the law; the laws of one instance share them. They are NULL where the functions that need them do
 * without. */
typedef struct Law {
    Device device;                      /* the parameters; `fidelity` is that of what moves */
    Inputs inputs;                      /* phase [rad], load [N] and frequency ratio [1], at the start if they grow */
    double middle_ratio;                /* frequency ratio [1] in the middle of a step in which it grows */
    Held held;                          /* what resolved motion needs */
    Bristle bristle;                    /* what friction needs; Coulomb friction has its coefficient alone */
    FastVibration fast;                 /* the steady vibration, of averaged motion alone */
    FrictionTable *table;               /* cache: means of expensive friction */
    const struct FrictionLaw *friction; /* row of the friction law, see friction_law.h */
    const struct Motion *motion;        /* row of the kind of motion, see motion.h */
    struct BendingTables *bending;      /* cache: panels of bending bristles */
} Law;

/* Change phase [rad] and load [N] of a law; nothing else prepared depends on these. */
void law_change(Law *law, double phase, double load);

/* Inputs that grow: the frequency `ratio` at first, and the rates of load [N/s] and ratio [1/s]. */
typedef struct {
    double ratio, load_rate, ratio_rate;
} Ramp;

/* Let inputs grow for `duration` [s]. The law must have been prepared with the frequency ratio in the
 * middle of that time. */
void law_ramp(Law *law, const Ramp *ramp, double duration);

/* The law `t` [s] later. */
Law law_after(const Law *law, double t);

#endif
