/* Complex numbers as a plain struct. C99's complex types are missing from some compilers, and slow in others because
 * they treat infinities, which do not occur here. */
#pragma once

#include <math.h>

#include "elementary_functions.h"

typedef struct {
    double re, im;
} Complex;

static inline Complex complex_of(double re, double im) {
    return (Complex){re, im};
}

/* length * exp(i angle) */
static inline Complex complex_rect(double length, double angle) {
    SineCosine of = elementary_sine_cosine(angle);
    return complex_of(length * of.cosine, length * of.sine);
}

static inline Complex complex_add(Complex a, Complex b) {
    return complex_of(a.re + b.re, a.im + b.im);
}

static inline Complex complex_sub(Complex a, Complex b) {
    return complex_of(a.re - b.re, a.im - b.im);
}

static inline Complex complex_mul(Complex a, Complex b) {
    return complex_of(a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re);
}

static inline Complex complex_scale(double factor, Complex a) {
    return complex_of(factor * a.re, factor * a.im);
}

static inline Complex complex_conj(Complex a) {
    return complex_of(a.re, -a.im);
}

static inline double complex_abs(Complex a) {
    return elementary_hypot(a.re, a.im);
}

/* exp(z), and the integrals over s from 0 to 1 of exp(z s) (`once`) and of (1 - s) exp(z s) (`twice`); regular at 0. */
typedef struct {
    Complex grown, once, twice;
} Growth;

Growth growth_of(Complex z);

/* Smith's division: no overflow where the quotient has none. */
static inline Complex complex_div(Complex a, Complex b) {
    if (fabs(b.re) >= fabs(b.im)) {
        double ratio = b.im / b.re, denominator = b.re + b.im * ratio;
        return complex_of((a.re + a.im * ratio) / denominator, (a.im - a.re * ratio) / denominator);
    }
    double ratio = b.re / b.im, denominator = b.re * ratio + b.im;
    return complex_of((a.re * ratio + a.im) / denominator, (a.im * ratio - a.re) / denominator);
}
