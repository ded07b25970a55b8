/* The event loop of Coulomb friction: closed-form motion from one event to the next.
 *
 * Events are a stop of the slider (then it sticks if friction can hold it, and reverses otherwise),
 * a release, and the lift-off and touchdown of the contact. There is no step size, no tolerance. */
#ifndef SLIDER_COULOMB_H
#define SLIDER_COULOMB_H

#include <stdbool.h>

#include "held.h"
#include "moment.h"
#include "refusal.h"

/* The first moment, at drive and normal phase 0. */
Moment coulomb_start(const Held *held, State state, double position);

/* The moment `duration` > 0 [s] later, inputs held. Refuses, with `after` undefined, where time
 * does not get on; `after` may be `moment`. Where numbers leave the range of floating point,
 * entries of `after` are not finite. */
bool coulomb_advance(const Held *held, const Moment *moment, double duration, Moment *after,
                     Refusal *refusal);

/* Contact mode of `state` under the held inputs. */
int coulomb_mode_of(const Held *held, const State *state, double theta, double psi);

/* Friction force [N] on the slider in contact mode `mode`, positive against +X. */
double coulomb_friction_force(const Held *held, const Moment *moment, int mode);

/* Friction force [N] that holds a slider at rest. */
double needed_force(const Plant *plant, const State *state, double theta);

/* Largest friction force [N] at normal phase `psi` [rad], 0 in flight. */
double friction_limit(const Plant *plant, double psi);

#endif
