/* Motion that leaps over periods: fidelity 0, averages of second order; see motion.h. */
#pragma once

#include "../resolved/motion.h"

extern const Motion LEAPING_MOTION;
