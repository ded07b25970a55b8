/* Steady velocity and blocking force for the present inputs: by averages of first order, or exact. */
#ifndef SLIDER_PREDICTION_H
#define SLIDER_PREDICTION_H

#include "../friction/law.h"
#include "../averaged/averaged.h"

/* Number of turns of the drive, at most 32, after which the normal load repeats; 0 if it does not. */
int turns_of_load(const Law *law);

/* The prediction of the averaging order of the device; `normal_lead` [rad] is psi - ratio theta.
 *
 * By second order both belong to periodic motions of the full device, found from those of first order on. Where none is
 * found, or the normal load never repeats, the prediction is that of first order and not `valid`. */
Averaged prediction_of(const Law *law, double normal_lead);

#endif
