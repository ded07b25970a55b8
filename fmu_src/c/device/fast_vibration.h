/* The steady vibration of slider and resonator without friction, in closed form (32)-(34). */
#ifndef SLIDER_FAST_VIBRATION_H
#define SLIDER_FAST_VIBRATION_H

#include <stdbool.h>

#include "../base/complex_number.h"
#include "../base/elementary_functions.h"
#include "../base/refusal.h"
#include "device.h"
#include "oscillator.h"

/* Velocity amplitudes [m/s]: v_q of the slider (`velocity`), and the one that the drive force gives to the
 * pair (`pair_velocity`). `lag` theta_1 [rad]. `resonator`: complex amplitude of e [m]. */
typedef struct {
    double velocity, pair_velocity, lag;
    Complex resonator;
} FastVibration;

/* Lag theta_1 [rad] of the equivalent `force`; adding 0 makes -0 a 0, which atan2 distinguishes. */
static inline double force_lag(Complex force) {
    return -elementary_atan2(force.im + 0.0, force.re);
}

/* Velocity amplitude v_q [m/s] that the equivalent `force` [N] gives to the pair. */
static inline double fast_velocity(const Device *device, Complex force) {
    return complex_abs(force) / (device_total_mass(device) * device->drive_frequency);
}

/* Refuses where undamped resonance leaves no steady vibration. */
bool fast_vibration_prepare(FastVibration *fast, const Device *device, Refusal *refusal);

/* Displacement [m] and velocity [m/s] of `amplitude` e at drive phase `theta` [rad]. */
static inline Response steady_swing(Complex amplitude, double theta, double frequency) {
    SineCosine turn = elementary_sine_cosine(theta);
    double sine = turn.sine, cosine = turn.cosine;
    return (Response){amplitude.re * sine + amplitude.im * cosine,
                      frequency * (amplitude.re * cosine - amplitude.im * sine)};
}

#endif
