/* The first zero of a smooth signal, by a search that cannot miss one.
 *
 * From a point where the signal f is positive, f(t + d) >= f + f' d - B d^2 / 2 while B bounds |f''|. The search
 * advances by the zero of that parabola: it approaches the first zero from the left and cannot step across it, nor
 * across a pair of close zeros. Once f'^2 > 2 B f holds with f' < 0, the next zero is simple and Newton's method
 * converges to it (Kantorovich), so the search ends there.
 *
 * A zero that is expected at some time is looked for there at once. It is the first one if the parabola from the start
 * and that from the zero backwards leave no gap between them. */
#pragma once

/* Signal f, f', and a bound of |f''| from this time on. */
typedef struct {
    double value, slope, bound;
} Signal;

typedef Signal (*SignalFunction)(void *motion, double t);

/* A signal whose first zero ends the mode, with the scales that its search needs: `noise` is the rounding error of its
 * values, and `fastest` [rad/s] its highest frequency. */
typedef struct {
    SignalFunction signal;
    void *motion;
    double noise, fastest;
} Watch;

/* Returned where there is no zero; times are not negative. */
#define NO_ZERO (-1.0)

/* Time of the first downward zero in [start, limit) [s], or NO_ZERO; fewer evaluations find it if it is near `expected`
 * [s], where NO_ZERO expects none.
 *
 * The signal is non-negative at `start`. Two zeros closer than 1e-7 / fastest enclose a dip within rounding and count
 * as a touch, which is no zero. */
double first_zero(const Watch *watch, double limit, double start, double expected);
