/* Steady velocity and blocking force for the present inputs: by averages of first order, or exact. */
#pragma once

#include "../averaged/first_order.h"

/* Largest number of turns of the drive after which the normal load may repeat. */
enum { MAX_TURNS_OF_LOAD = 32 };

/* The prediction of the averaging order of the device; `normal_lead` [rad] is psi - ratio theta. Where second order
 * finds no periodic motion, or the normal load never repeats, it is that of first order and not `valid`. */
Prediction prediction_of(const System *system, double normal_lead, Quantity quantity);
