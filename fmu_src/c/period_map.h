/* The map of the full device over the period of a periodic motion, under a load that is held.
 *
 * The section is drive phase theta = 0; the phase of the normal load there is `lead`. A period is `turns`
 * of the drive, after which the normal load repeats too. The loop over events resolves the motion with
 * two degrees of freedom, whatever the fidelity of the device. */
#ifndef SLIDER_PERIOD_MAP_H
#define SLIDER_PERIOD_MAP_H

#include <stdbool.h>

#include "law.h"

/* Largest tolerance of a map under LuGre friction. */
#define MAP_TOLERANCE 1e-10

/* `law` is that of the full device, `fast` its vibration without friction. `period` [s]; `speed` [m/s],
 * `swing` [m] and `force` [N] are the scales of velocity (v_q), resonator and load (what stops v_q in a
 * period). `states` is the number of states that a period maps: the bristle is one under LuGre friction. */
typedef struct {
    Law law;
    FastVibration fast;
    int turns, states;
    double period, speed, swing, force;
} PeriodMap;

/* The map of `device` under `turns * ratio` waves, an integer, of the normal load. Refuses where device
 * and friction law do not fit, and where undamped resonance leaves no steady vibration. */
bool period_map_prepare(PeriodMap *map, const Device *device, double ratio, int turns,
                        Refusal *refusal);

/* Momentum over total mass without that of the drive, W = X' + r Y' + D / (Mt w) [m/s], of a state at
 * the section. */
double section_momentum(const PeriodMap *map, const State *state);

/* Bring `section`, with its state, bristle and stops, to the section: phases, mode and counts. */
void section_enter(const PeriodMap *map, double lead, Moment *section);

/* The moment a period after `section` under `load` [N]; its position is the way since. False where time
 * does not get on or numbers leave the range of floating point. */
bool period_map_apply(const PeriodMap *map, double lead, double load, const Moment *section,
                      Moment *after);

/* Friction [N] while the slider slides forward all the time: its mean over a period. */
double sliding_friction(const PeriodMap *map, double lead);

#endif
