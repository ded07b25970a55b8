/* The control law: proportional and integral, in terms of the effort u = sin(phase + theta1).
 *
 * The mean force that the vibration has on the slider is proportional to u, (20), and grows with
 * the phase while |phase + theta1| < pi/2. In terms of u the loop has one gain at every phase. */
#ifndef CONTROLLER_CONTROL_H
#define CONTROLLER_CONTROL_H

/* What the law carries from sample to sample, both within the limit of the effort at its time. */
typedef struct {
    double integral, effort;
} Control;

/* Gains [s/m], [1/m], limit of the effort's magnitude, sample time [s]. */
typedef struct {
    double proportional_gain, integral_gain, effort_limit, sample_time;
} Tuning;

/* The law after a sample with a velocity error [m/s], positive for a slider that is too slow.
 *
 * The integral rests while the effort is at its limit and the error would drive it further, so
 * that it does not wind up. */
Control control_sampled(const Tuning *tuning, Control before, double error);

/* The phase [rad] with this effort, where the velocity grows with it. */
double control_phase(double effort, double force_phase);

#endif
