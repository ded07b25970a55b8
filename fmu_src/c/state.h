/* What moves: the slider and its resonator. */
#ifndef SLIDER_STATE_H
#define SLIDER_STATE_H

/* Slider velocity [m/s], resonator displacement [m] and velocity [m/s]. */
typedef struct {
    double velocity, displacement, rate;
} State;

/* Spacing of floating point numbers above 1: the unit of rounding errors. */
#define EPSILON 0x1p-52

#define PI ((double)3.14159265358979323846) /* some compilers keep more digits of a constant */
#define TAU (2.0 * PI)

#endif
