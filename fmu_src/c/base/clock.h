/* Time within a step, summed without loss. */
#pragma once

/* Time `elapsed` [s] of a step of `duration` [s], with the rounding error of that sum in `carry`. */
typedef struct {
    double duration, elapsed, carry;
} Clock;

static inline Clock clock_of(double duration) {
    return (Clock){duration, 0.0, 0.0};
}

/* Advances by `t` [s] and returns the time left [s]; two-sum keeps the rounding errors. */
static inline double clock_advance(Clock *clock, double t) {
    double before = clock->elapsed;
    double total = before + t;
    double carried = total - before;
    clock->carry += (before - (total - carried)) + (t - carried);
    clock->elapsed = total;
    return (clock->duration - total) - clock->carry;
}
