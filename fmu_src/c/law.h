/* A device under held inputs, resolved or averaged, by one face: start, advance, contact mode and
 * friction force. */
#ifndef SLIDER_LAW_H
#define SLIDER_LAW_H

#include <stdbool.h>

#include "bristle.h"
#include "device.h"
#include "event_search.h"
#include "fast_vibration.h"
#include "friction_table.h"
#include "held.h"
#include "moment.h"
#include "refusal.h"
#include "slow_phase.h"

/* `friction` is the row of its friction law, see friction_law.h. `table` is a cache that outlives
 * the law and may be shared by those of one instance; it is filled when averaged motion first needs
 * it.
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
} Law;

/* Prepares the law of `device` under `inputs`. Refuses where device and law do not fit; `law` is
 * then undefined. */
bool law_prepare(Law *law, const Device *device, const Inputs *inputs, FrictionTable *table,
                 Refusal *refusal);

/* Gives a law of resolved motion another phase [rad] and load [N], on which nothing else that is
 * prepared depends. */
void law_change(Law *law, double phase, double load);

/* Inputs that grow, per s, from a frequency ratio on. */
typedef struct {
    double ratio, load_rate, ratio_rate;
} Ramp;

/* Lets inputs grow for `duration` [s], from now on. The law was prepared with the frequency ratio in the
 * middle of that time. */
void law_ramp(Law *law, const Ramp *ramp, double duration);

/* The law `t` [s] later. */
Law law_after(const Law *law, double t);

/* The slow phase of the normal load. */
SlowPhase law_slow_phase(const Law *law);

/* Whether the law needs `resolved` and `orbits`: fidelity 0 by averages of second order, where motion
 * becomes slow. */
bool law_follows_orbits(const Law *law);

/* The first moment, at drive and normal phase 0, from the initial values of the device. */
Moment law_start(const Law *law);

/* The moment `duration` > 0 [s] later, another than `moment`, or that of the event that a `search`
 * finds before; NULL searches for none, and averaged motion has none. Refuses, with `after`
 * undefined, where time does not get on or averaged motion needs too many steps. Numbers that leave
 * the range of floating point show as non-finite entries of `after`, never as an endless loop. */
bool law_advance(const Law *law, const Moment *moment, double duration, EventSearch *search,
                 Moment *after, Refusal *refusal);

/* Contact mode under the held inputs. */
int law_mode(const Law *law, const Moment *moment);

/* Friction force [N] on the slider in contact mode `mode`, positive against +X. */
double law_friction_force(const Law *law, const Moment *moment, int mode);

/* The estimate of the error of the slow velocity at fidelity 0 [m/s]; 0 for resolved motion. */
double law_slow_motion_error(const Law *law, const Moment *moment);

#endif
