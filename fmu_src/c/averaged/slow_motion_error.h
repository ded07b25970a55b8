/* Estimate of the error that averages of first order make in the slow velocity. */
#ifndef SLIDER_SLOW_MOTION_ERROR_H
#define SLIDER_SLOW_MOTION_ERROR_H

#include "../friction/law.h"

/* Error [m/s]: in proportion to the share of friction in the inertia of the vibration. */
double first_order_error(const Law *law);

#endif
