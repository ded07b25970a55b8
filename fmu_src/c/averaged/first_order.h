/* Averaged motion under fast vibration, for any frequency ratio and for lifting contact.
 *
 * The fast velocity of the slider is V - v_q cos(tau) with tau = theta - theta_1, so that it slides forward while tau
 * is in (Theta, 2 pi - Theta), cos(Theta) = V / v_q. With n = frequency_ratio an integer, the normal load is N(n tau +
 * delta) and the mean friction is an elementary integral over those two arcs (eq. 4 for n = 1 without flight). At any
 * other ratio all phases are met and the mean load counts. The error is of the order of the friction share times
 * v_q. */
#pragma once

#include "../friction/system.h"

/* A quantity that is predicted [m/s, N], its value, and whether it applies. Friction `holds` a load below that of
 * sliding. */
typedef enum { STEADY_VELOCITY, BLOCKING_FORCE, QUANTITIES } Quantity;
typedef struct {
    double value;
    bool holds, valid;
} Prediction;

/* Averaged theory of the device and inputs of a system (eqs 20-22 with both faces).
 *
 * `normal_lead` [rad] is psi - n theta, which earlier changes of the ratio make different from 0. Where the load
 * exceeds full friction the velocity is the limit v_q of the theory, with its sign. Both results are 0 without
 * vibration, and where undamped resonance leaves no steady vibration. In these cases, and where the vibration does not
 * break the contact loose, they are not `valid`. */
Prediction first_order_prediction(const System *system, double normal_lead, Quantity quantity);
