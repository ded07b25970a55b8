/* The event loop of LuGre friction (eq. 8): from one reversal to the next along the bristle's path.
 *
 * Soon after a reversal the bristle is fully bent and friction is Coulomb's: closed forms take
 * over. Until then Taylor series follow the path, whose length shrinks with the bristle stiffness,
 * so the cost does not grow with it. There is no sticking; presliding is resolved as what it is, an
 * oscillation on the bristles. */
#ifndef SLIDER_LUGRE_H
#define SLIDER_LUGRE_H

#include <stdbool.h>

#include "bristle.h"
#include "held.h"
#include "moment.h"
#include "refusal.h"

/* The first moment, with the bristle deflected by `deflection` [m]. */
Moment lugre_start(const Held *held, const Bristle *bristle, State state, double position,
                   double deflection);

/* The moment `duration` > 0 [s] later, inputs held, to relative `tolerance`. Refuses, with `after`
 * undefined, where time does not get on; `after` may be `moment`. Where numbers leave the range of
 * floating point, entries of `after` are not finite. */
bool lugre_advance(const Held *held, const Bristle *bristle, double tolerance, const Moment *moment,
                   double duration, Moment *after, Refusal *refusal);

/* Contact mode: lifted, or the direction of sliding; 0 only at rest. */
int lugre_mode_of(const Held *held, const State *state, double psi);

/* Friction force [N] on the slider in contact mode `mode` (eq. 8), positive against +X. */
double lugre_friction_force(const Held *held, const Bristle *bristle, const Moment *moment,
                            int mode);

#endif
