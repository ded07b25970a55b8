/* Time within a step, summed without loss. */
#ifndef SLIDER_CLOCK_H
#define SLIDER_CLOCK_H

/* What is left of a step of `duration` [s], after any number of advances. */
typedef struct {
    double duration, elapsed, carry;
} Clock;

static inline Clock clock_of(double duration) {
    return (Clock){duration, 0.0, 0.0};
}

/* Counts `t` [s] and returns what is left [s]; two-sum keeps the rounding. */
static inline double clock_advance(Clock *clock, double t) {
    double before = clock->elapsed;
    double total = before + t;
    double carried = total - before;
    clock->carry += (before - (total - carried)) + (t - carried);
    clock->elapsed = total;
    return (clock->duration - total) - clock->carry;
}

#endif
