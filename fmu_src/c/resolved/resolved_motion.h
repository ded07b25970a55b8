/* Resolved motion, and what motion that leaps over periods shares with it; see motion.h. */
#pragma once

#include "motion.h"

Moment resolved_start(const Law *law);
int resolved_mode(const Law *law, const Moment *moment);
double resolved_force(const Law *law, const Moment *moment, int mode);
double resolved_power(const Law *law, const Moment *moment);

Rates resolved_rates(const Law *law, const Moment *moment);

/* The error that leaps have left in the slow velocity. */
double resolved_error(const Law *law, const Moment *moment);
