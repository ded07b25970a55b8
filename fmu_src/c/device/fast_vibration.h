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
