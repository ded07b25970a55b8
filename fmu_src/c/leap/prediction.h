/* Steady velocity and blocking force for the present inputs: by averages of first order, or exact. */
#pragma once

#include "../averaged/first_order.h"

/* Number of turns of the drive, at most 32, after which the normal load repeats; 0 if it does not. */
int turns_of_load(const System *system);

/* The prediction of the averaging order of the device; `normal_lead` [rad] is psi - ratio theta. Where second order
 * finds no periodic motion, or the normal load never repeats, it is that of first order and not `valid`. */
Prediction prediction_of(const System *system, double normal_lead, Quantity quantity);
