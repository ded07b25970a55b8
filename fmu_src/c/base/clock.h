/* Time within a step, summed without loss. */
#pragma once

/* Time `elapsed` [s] of a step of `duration` [s], with the rounding error of that sum in `carry`. */
typedef struct {
    double duration, elapsed, carry;
} Clock;

static inline Clock clock_of(double duration) {
    return (Clock){duration, 0.0, 0.0};
}

/* The rounding error of `a` + `b` (two-sum). */
static inline double lost_in_sum(double a, double b) {
    double sum = a + b, added = sum - a;
    return (a - (sum - added)) + (b - added);
}

/* Advances by `t` [s] and returns the time left [s]. */
static inline double clock_advance(Clock *clock, double t) {
    clock->carry += lost_in_sum(clock->elapsed, t);
    clock->elapsed += t;
    return (clock->duration - clock->elapsed) - clock->carry;
}
