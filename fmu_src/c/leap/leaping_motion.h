/* Motion that leaps over periods: fidelity 0, averages of second order; see motion.h. */
#ifndef SLIDER_LEAPING_MOTION_H
#define SLIDER_LEAPING_MOTION_H

#include "../resolved/motion.h"

extern const Motion LEAPING_MOTION;

#endif
