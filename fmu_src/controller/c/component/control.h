/* The control law: proportional and integral, for the effort u = sin(phase + theta1).
 *
 * The mean force of the vibration on the slider is proportional to u, (20), so the gain of the loop does not depend on
 * the phase. It grows with the phase while |phase + theta1| < pi/2. */
#pragma once

/* The state of the law, each within the effort limit at the time of its sample. */
typedef struct {
    double integral, effort;
} Control;

/* Gains [s/m] and [1/m], largest magnitude of the effort, sample time [s]. */
typedef struct {
    double proportional_gain, integral_gain, effort_limit, sample_time;
} Tuning;

/* The state after a sample with a velocity error [m/s], positive for a slider that is too slow.
 *
 * The integral is frozen while the effort is at its limit and the error would drive it further (anti-windup). */
Control control_sampled(const Tuning *tuning, Control before, double error);

/* The phase [rad] with this effort, on the branch where the velocity grows with the phase. */
double control_phase(double effort, double force_phase);
