/* Dormand and Prince's 5(4) pair for one velocity and the displacement, its integral. */
#ifndef SLIDER_DORMAND_PRINCE_H
#define SLIDER_DORMAND_PRINCE_H

/* Acceleration [m/s^2] at time `t` [s] and velocity `v` [m/s]. */
typedef double (*AccelerationFunction)(const void *motion, double t, double v);

/* Where an integration is: time [s], velocity [m/s], displacement [m], the step size to try next [s], and
 * the number of steps `tried`. */
typedef struct {
    double t, velocity, moved, step;
    int tried;
} Reached;

/* Integrate to time `end` [s], or for `max_steps` accepted and rejected steps. `tolerance` [m/s] is the
 * error allowed in a step. `longest` [s] bounds the step size: over the period of a periodic acceleration
 * all stages would see the same value. */
Reached integrate(AccelerationFunction acceleration, const void *motion, Reached from, double end,
                  double tolerance, double longest, int max_steps);

#endif
