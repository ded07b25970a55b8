/* Work of full friction on a slider that slides, in closed form.
 *
 * With s the direction of sliding and K the integral of n X', n = exp(i chi), the work is s (F0 (X - X_0) + F1 Im K).
 * Partial integration of both equations of motion gives K from the states and phases at the ends: with r = m / (M + m)
 * and T the response of the sliding resonator, of stiffness k and decay d, to exp(-i q t),
 *
 *   i q K = [n (X' + r T ((k - 2 i d q) Y' - i q k Y))] - integral of n (P + r q^2 T G)
 *
 * where P are the forces on the pair per total mass, and G those on the resonator per its mass. */
#pragma once

#include "plant.h"

/* Coefficients of n Y', n Y and n in i q K; then, for n exp(i theta) and n exp(-i theta), the `frequency` [rad/s] of
 * the phasor and its coefficient: in the integral (`forced`), or after integration (`swung`), 0 for the other one. */
typedef struct {
    Complex rate, displacement, steady, forced[2], swung[2];
    double frequency[2];
} SlideWork;

/* Prepare them for a normal load that swings, at a frequency other than 0. */
SlideWork slide_work_of(const Plant *plant);

/* An end of a slide: exp(i theta) and exp(i chi), and the state. */
typedef struct {
    Complex drive, normal;
    State state;
} SlideEnd;

/* Im K [m] of a slide of `t` [s] in direction `sign`. */
double slide_work_swung(const SlideWork *work, const Plant *plant, int sign, double t, const SlideEnd *first,
                        const SlideEnd *last);
