/* A device under held inputs, resolved or averaged, behind one interface: start, advance, contact mode,
 * friction force. */
#ifndef SLIDER_LAW_H
#define SLIDER_LAW_H

#include <stdbool.h>

#include "bristle.h"
#include "budget.h"
#include "device.h"
#include "event_search.h"
#include "fast_vibration.h"
#include "friction_table.h"
#include "held.h"
#include "moment.h"
#include "refusal.h"
#include "slow_phase.h"

/* `friction` is the table of functions of its friction law, see friction_law.h. `table` is a cache that
 * outlives the law and is shared by the laws of one instance; averaged motion fills it when first needed.
 *
 * `bending` is a cache for panels of LuGre friction, kept by the component; NULL where series are used
 * instead, as while inputs vary.
 *
 * `middle_ratio` is the frequency ratio in the middle of a step in which it grows.
 *
 * Averages of second order have the law of the full device (`resolved`) and a cache of its orbits, both
 * kept by the component; elsewhere these are NULL. */
typedef struct Law {
    Device device;
    Inputs inputs;
    double middle_ratio;
    Held held;
    Bristle bristle;
    FastVibration fast;
    FrictionTable *table;
    const struct FrictionLaw *friction;
    const struct Law *resolved;
    struct OrbitTables *orbits;
    struct BendingTables *bending;
} Law;

/* Prepares the law of `device` under `inputs`. Refuses where device and law do not fit; `law` is
 * then undefined. */
bool law_prepare(Law *law, const Device *device, const Inputs *inputs, FrictionTable *table,
                 Refusal *refusal);

/* Changes phase [rad] and load [N] of a law of resolved motion; nothing else prepared depends on these. */
void law_change(Law *law, double phase, double load);

/* Inputs that grow: the frequency `ratio` at first, and the rates of load [N/s] and ratio [1/s]. */
typedef struct {
    double ratio, load_rate, ratio_rate;
} Ramp;

/* Lets inputs grow for `duration` [s]. The law must have been prepared with the frequency ratio in the
 * middle of that time. */
void law_ramp(Law *law, const Ramp *ramp, double duration);

/* The law `t` [s] later. */
Law law_after(const Law *law, double t);

/* The slow phase of the normal load. */
SlowPhase law_slow_phase(const Law *law);

/* Whether the law needs `resolved` and `orbits`: at fidelity 0 with averages of second order, if the
 * device has slow motion. */
bool law_follows_orbits(const Law *law);

/* The first moment, at drive and normal phase 0, from the initial values of the device. */
Moment law_start(const Law *law);

/* Advance by `duration` > 0 [s] from `moment` to `after`, another moment, or to the event that a `search`
 * finds before; NULL searches for none, and averaged motion has no events. Refuses, with `after`
 * undefined, a motion of more legs or steps than the budget of the communication step has. Where numbers leave the range of floating point, entries
 * of `after` are not finite; loops end all the same. */
bool law_advance(const Law *law, const Moment *moment, double duration, EventSearch *search,
                 Budget *budget, Moment *after, Refusal *refusal);

/* Contact mode under the held inputs. */
int law_mode(const Law *law, const Moment *moment);

/* Friction force [N] on the slider in contact mode `mode`, positive against +X. */
double law_friction_force(const Law *law, const Moment *moment, int mode);

/* Brings the estimate of the error up to a moment at which the law ends. */
void law_settle_error(const Law *law, Moment *moment);

/* The estimate of the error of the slow velocity at fidelity 0 [m/s]; 0 for resolved motion. */
double law_slow_motion_error(const Law *law, const Moment *moment);

#endif
