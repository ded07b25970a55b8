/* Numbers of every file. */
#ifndef SLIDER_NUMBER_H
#define SLIDER_NUMBER_H

/* Spacing of floating point numbers above 1: the unit of rounding errors. */
#define EPSILON 0x1p-52

#define PI ((double)3.14159265358979323846) /* some compilers keep more digits of a constant */
#define TAU (2.0 * PI)

#endif
