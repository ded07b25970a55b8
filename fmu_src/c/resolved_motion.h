/* What motion that leaps over periods shares with resolved motion; see motion.h. */
#ifndef SLIDER_RESOLVED_MOTION_H
#define SLIDER_RESOLVED_MOTION_H

#include "constants.h"
#include "motion.h"

Moment resolved_start(const Law *law);
int resolved_mode(const Law *law, const Moment *moment);
double resolved_force(const Law *law, const Moment *moment, int mode);
Rates resolved_rates(const Law *law, const Moment *moment);

#endif
