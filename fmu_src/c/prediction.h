/* Steady velocity and blocking force for the present inputs: by averages of first order, or exact. */
#ifndef SLIDER_PREDICTION_H
#define SLIDER_PREDICTION_H

#include "averaged.h"
#include "law.h"

/* The prediction of the averaging order of the device; `normal_lead` [rad] as for `averaged`.
 *
 * By second order both belong to periodic motions of the full device. Where the normal load never repeats
 * there are none, and the prediction is that of first order. It is of first order and not `valid` where the
 * vibration does not decay, where no steady motion or more than one is found, and at fidelity 0 where the
 * motion itself is averaged to first order. */
Averaged prediction_of(const Law *law, double normal_lead);

#endif
