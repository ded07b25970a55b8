/* A law: a device under held inputs, with all that follows from these alone. */
#ifndef SLIDER_LAW_H
#define SLIDER_LAW_H

#include <stdbool.h>

#include "bristle.h"
#include "device.h"
#include "fast_vibration.h"
#include "friction_table.h"
#include "held.h"
#include "refusal.h"

/* `friction` is the row of functions of its friction law, see friction_law.h, and `motion` that of its kind of
 * motion, see motion.h. `fast` is the steady vibration at fidelity 0 and 1.
 *
 * `table` and `bending` are caches that outlive the law, shared by the laws of one instance: `table` for means
 * of LuGre friction, `bending` for panels of it. NULL where the functions that need them do without.
 *
 * `middle_ratio` is the frequency ratio in the middle of a step in which it grows. */
typedef struct Law {
    Device device;
    Inputs inputs;
    double middle_ratio;
    Held held;
    Bristle bristle;
    FastVibration fast;
    FrictionTable *table;
    const struct FrictionLaw *friction;
    const struct Motion *motion;
    struct BendingTables *bending;
} Law;

/* Prepare all of a law but its motion and caches. Refuses where device and friction law do not fit; `law` is then
 * undefined. */
bool law_prepare(Law *law, const Device *device, const Inputs *inputs, Refusal *refusal);

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
