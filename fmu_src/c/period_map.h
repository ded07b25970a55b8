/* The map of the full device over the period of a periodic motion, under a load that is held.
 *
 * A period is `turns` of the drive, after which the normal load repeats too; at drive phase theta =
 * 0 the phase of the normal load is `lead`. The loop over events resolves the motion with two
 * degrees of freedom, whatever the fidelity of the device.
 *
 * The map begins at a section, where the vibration without friction is fastest forward, or
 * backward: next to it the slider neither turns back nor sticks, and a bristle has forgotten how it
 * was bent. */
#ifndef SLIDER_PERIOD_MAP_H
#define SLIDER_PERIOD_MAP_H

#include <stdbool.h>

#include "law.h"

/* Largest tolerance of a map under LuGre friction. */
#define MAP_TOLERANCE 1e-10

/* `law` is that of the full device, `fast` its vibration without friction. `period` [s]; `speed`
 * [m/s], `swing` [m] and `force` [N] are the scales of velocity (v_q), resonator and load (what
 * stops v_q in a period). `states` is the number of states that a period maps: the bristle is one
 * under LuGre friction. */
typedef struct {
    Law law;
    FastVibration fast;
    int turns, states;
    double period, speed, swing, force;
} PeriodMap;

/* The map of `device` under `turns * ratio` waves, an integer, of the normal load. Refuses where
 * device and friction law do not fit, and where undamped resonance leaves no steady vibration. */
bool period_map_prepare(PeriodMap *map, const Device *device, double ratio, int turns,
                        Refusal *refusal);

/* Drive phase [rad] of the section where the vibration is fastest in `direction`, 1 or -1. */
double section_phase(const PeriodMap *map, int direction);

/* Momentum over total mass without that of the drive, W = X' + r Y' + D / (Mt w) cos(theta) [m/s]. */
double momentum_velocity(const PeriodMap *map, const State *state, double theta);

/* Begin at drive phase `theta` [rad] with the state, the bristle and the stops that `moment` has:
 * its phases, mode and counts; its position is 0. */
void orbit_enter(const PeriodMap *map, double lead, double theta, Moment *moment);

/* The moment `duration` [s] after one that orbit_enter began, under `load` [N]. False where time
 * does not get on or numbers leave the range of floating point. */
bool orbit_advance(const PeriodMap *map, double lead, double load, const Moment *moment,
                   double duration, Moment *after);

/* Friction [N] while the slider slides forward all the time: its mean over a period. */
double sliding_friction(const PeriodMap *map, double lead);

#endif
