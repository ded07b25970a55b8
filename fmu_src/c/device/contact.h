/* When the contact lifts and touches down: N = max(0, N0 + dN sin(chi)) with dN > N0. */
#pragma once

#include "plant.h"

/* Contact modes: the direction of sliding, rest, or flight. */
enum { BACKWARD = -1, STICK = 0, FORWARD = 1, LIFTED = 2 };

/* BACKWARD, FORWARD, or STICK at rest. */
static inline int direction_of(double velocity) {
    return (velocity > 0.0) - (velocity < 0.0);
}

/* Whether the contact is lifted at normal phase `psi` [rad].
 *
 * On a boundary this depends on the direction in which the phase moves. Where it stands still the contact is lifted
 * where the normal load is 0. */
bool is_lifted(const Plant *plant, double psi);

/* Time [s] until the contact lifts, or touches down when `lifted`, from normal phase `psi` [rad] on; infinite if never.
 * It is valid until the normal frequency changes its sign. */
double time_to_switch(const Plant *plant, double psi, bool lifted);
