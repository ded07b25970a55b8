/* Dormand and Prince's 5(4) pair for one velocity and the position that it sums up to. */
#ifndef SLIDER_DORMAND_PRINCE_H
#define SLIDER_DORMAND_PRINCE_H

/* Acceleration [m/s^2] at time `t` [s] and velocity `v` [m/s]. */
typedef double (*AccelerationFunction)(const void *motion, double t, double v);

/* A motion on its way: time [s], velocity [m/s], displacement [m], and the `step` [s] to try next. */
typedef struct {
    double t, velocity, moved, step;
} Passage;

/* Carries the passage on to time `end` [s], or for `most` accepted and rejected steps if those do
 * not suffice. `tolerance` [m/s] is allowed per step. */
Passage integrate(AccelerationFunction acceleration, const void *motion, Passage from, double end,
                  double tolerance, int most);

#endif
