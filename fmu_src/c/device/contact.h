/* When the contact lifts and touches down: N = max(0, N0 + dN sin(chi)) with dN > N0. */
#pragma once

#include "plant.h"

/* Contact modes: the direction of sliding, rest, or flight. */
enum { BACKWARD = -1, STICK = 0, FORWARD = 1, LIFTED = 2 };

/* BACKWARD, FORWARD, or STICK at rest. */
static inline int direction_of(double velocity) {
    return (velocity > 0.0) - (velocity < 0.0);
}

/* Whether the contact is lifted at normal phase `chi` [rad].
 *
 * On a boundary this depends on the direction in which the phase moves: `frequency` [rad/s] is its rate. At rate 0 the
 * contact is lifted where the normal load is 0. */
bool is_lifted(const Plant *plant, double chi, double frequency);

/* Time [s] until the contact lifts, or touches down when `lifted`; infinite if never. `frequency` [rad/s] is that of
 * the normal load and may be negative; it grows by `rate` [rad/s^2], and the time is valid until it changes its
 * sign. */
double time_to_switch(const Plant *plant, double chi, double frequency, double rate, bool lifted);

/* Limit of the friction force [N] of all faces at normal phase `psi` [rad]; 0 in flight. */
double friction_limit(const Plant *plant, double psi);
