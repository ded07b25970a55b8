/* Elementary functions that give the same bits on every platform.
 *
 * Libraries differ in the last bit of sine and exponential, and a search or a difference quotient makes more of it.
 * These consist of sums, products, quotients and square roots only, which IEEE 754 defines to the last bit. Where
 * nothing depends on it, which is far outside the range of motion (angles beyond 1e6 rad, results that overflow or are
 * subnormal, arguments that are not finite), they are those of the library.
 *
 * Errors are up to 4 units in the last place, those of sine and cosine where they pass through 0 up to 1e-25 for each
 * quarter turn. */
#pragma once

typedef struct {
    double sine, cosine;
} SineCosine;

SineCosine elementary_sine_cosine(double x);
double elementary_sin(double x);
double elementary_cos(double x);
double elementary_asin(double x);
double elementary_acos(double x);
double elementary_atan2(double y, double x);
double elementary_hypot(double x, double y);
double elementary_exp(double x);
double elementary_expm1(double x);
double elementary_log(double x);
