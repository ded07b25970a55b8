/* Numbers of every file. */
#pragma once

#include <math.h>

/* Spacing of floating point numbers above 1: the unit of rounding errors. */
#define EPSILON 0x1p-52

#define PI ((double)3.14159265358979323846) /* some compilers keep more digits of a constant */
#define TAU (2.0 * PI)

/* Smallest number that is divided by where it may be 0: compilers divide before they choose, and hosts may trap x /
 * 0. */
#define SMALLEST 1e-300

/* `angle` [rad] modulo 2 pi, in [0, 2 pi); exact for angles >= 0. */
static inline double within_turn(double angle) {
    if (angle >= 0.0 && angle < 2.0 * TAU) {
        return angle < TAU ? angle : angle - TAU;
    }
    double rest = fmod(angle, TAU);
    return rest < 0.0 ? rest + TAU : rest;
}
