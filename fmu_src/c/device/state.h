/* What moves: the slider and its resonator. */
#ifndef SLIDER_STATE_H
#define SLIDER_STATE_H

#include "../base/number.h"

/* Slider velocity [m/s], resonator displacement [m] and velocity [m/s]. */
typedef struct {
    double velocity, displacement, rate;
} State;

#endif
