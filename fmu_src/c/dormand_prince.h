/* Dormand and Prince's 5(4) pair for one velocity and the position that it sums up to. */
#ifndef SLIDER_DORMAND_PRINCE_H
#define SLIDER_DORMAND_PRINCE_H

/* Acceleration [m/s^2] at time `t` [s] and velocity `v` [m/s]. */
typedef double (*AccelerationFunction)(const void *motion, double t, double v);

/* What an integration has reached: time [s], velocity [m/s], displacement [m], and the next `step`
 * [s] to try. */
typedef struct {
    double t, velocity, moved, step;
} Reached;

/* Integrate to time `end` [s], or for at most `most` accepted and rejected steps. `tolerance` [m/s]
 * is allowed per step, and `longest` [s] is that of steps: what repeats must not look constant to all
 * stages. */
Reached integrate(AccelerationFunction acceleration, const void *motion, Reached from, double end,
                  double tolerance, double longest, int most);

#endif
