/* Angles within a turn. */
#ifndef SLIDER_ANGLE_H
#define SLIDER_ANGLE_H

#include <math.h>

#include "number.h"

/* `angle` [rad] modulo 2 pi, in [0, 2 pi); exact for angles >= 0. */
static inline double within_turn(double angle) {
    if (angle >= 0.0 && angle < 2.0 * TAU) {
        return angle < TAU ? angle : angle - TAU;
    }
    double rest = fmod(angle, TAU);
    return rest < 0.0 ? rest + TAU : rest;
}

#endif
