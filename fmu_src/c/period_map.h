/* The period map: the state of the full device after one period under a constant load.
 *
 * A period is `turns` of the drive, after which the normal load repeats too; at drive phase theta = 0 the
 * phase of the normal load is `lead`. The motion is resolved event by event with two degrees of freedom,
 * whatever the fidelity of the device.
 *
 * The map begins at a section, the drive phase at which the vibration without friction is fastest forward,
 * or backward: near it the slider neither reverses nor sticks, and a bristle is fully bent. */
#ifndef SLIDER_PERIOD_MAP_H
#define SLIDER_PERIOD_MAP_H

#include <stdbool.h>

#include "law.h"
#include "trace.h"

/* Largest tolerance of a map under LuGre friction. */
#define MAP_TOLERANCE 1e-10

/* `law` is that of the full device, `fast` its vibration without friction. `period` [s]; `speed` [m/s],
 * `swing` [m] and `force` [N] are the scales of velocity (v_q), resonator displacement and load (the force
 * that stops v_q in a period). `states` is the number of states that are mapped: 3, with LuGre friction 4. */
typedef struct {
    Law law;
    FastVibration fast;
    int turns, states;
    double period, speed, swing, force;
} PeriodMap;

/* Prepare the map of `device` at a frequency ratio for which `turns * ratio` is an integer. Refuses where
 * device and friction law do not fit, and where undamped resonance leaves no steady vibration. */
bool period_map_prepare(PeriodMap *map, const Device *device, double ratio, int turns,
                        Refusal *refusal);

/* Drive phase [rad] of the section where the vibration is fastest in `direction`, 1 or -1. */
double section_phase(const PeriodMap *map, int direction);

/* Momentum of the pair over total mass, without the part that the drive makes:
 * W = X' + r Y' + D / (Mt w) cos(theta) [m/s]. */
double momentum_velocity(const PeriodMap *map, const State *state, double theta);

/* Set phases, contact mode and counts of a `moment` for a motion that begins at drive phase `theta` [rad],
 * at position 0; its state, bristle and stops are kept. */
void orbit_enter(const PeriodMap *map, double lead, double theta, Moment *moment);

/* Advance by `duration` [s] from a moment that orbit_enter prepared, under `load` [N]. False where the motion
 * takes too many legs or numbers leave the range of floating point. */
bool orbit_advance(const PeriodMap *map, double lead, double load, const Moment *moment,
                   double duration, Moment *after);

/* The same with a `trace` that looks at the motion on its way. */
bool orbit_trace(const PeriodMap *map, double lead, double load, const Moment *moment,
                 double duration, Trace *trace, Moment *after);

/* Mean friction [N] over a period in which the slider slides forward throughout. */
double sliding_friction(const PeriodMap *map, double lead);

#endif
