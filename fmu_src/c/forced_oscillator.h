/* A damped oscillator under linear and sinusoidal forcing, from any state, regular everywhere.
 *
 * Steady responses of moderate size are split off. The rest is a free motion plus responses from rest: to
 * the linear forcing, to forcing that resonates, and to slow forcing of a slow oscillator. */
#ifndef SLIDER_FORCED_OSCILLATOR_H
#define SLIDER_FORCED_OSCILLATOR_H

#include "oscillator.h"

/* Drive and normal load. */
enum { FORCINGS = 2 };

/* Re(amplitude exp(i frequency t)), in rad/s and m/s^2. */
typedef struct {
    double frequency;
    Complex amplitude;
} Forcing;

/* How the response to a forcing is followed: as part of the constant, steady, or from rest. */
typedef enum { AS_CONSTANT, STEADY, RESONANT_FROM_REST, SLOW_FROM_REST } Following;

/* y'' + 2 decay y' + stiffness y = constant + slope t + sum of the forcings. `steady` are the complex
 * amplitudes of steady responses [m], `size` their absolute values; the free motion starts at
 * displacement `free_displacement` [m] and `free_rate` [m/s]. Samples are taken up to `longest` [s]. */
typedef struct {
    const Oscillator *oscillator;
    double constant, slope;
    int forcings;
    Forcing forcing[FORCINGS];
    Following following[FORCINGS];
    Complex steady[FORCINGS];
    double size[FORCINGS];
    double free_displacement, free_rate;
    bool from_rest;
    double horizon, longest;
} ForcedOscillator;

/* Displacement y [m] and derivatives, with bounds on |y'|, |y''| and |y'''| over the horizon.
 * `turn` are exp(i frequency t) of the forcings. */
typedef struct {
    Complex turn[FORCINGS];
    double displacement, rate, acceleration;
    double rate_bound, acceleration_bound, jerk_bound;
} Sample;

/* exp(i frequency t) for each of `count` <= FORCINGS forcings. */
static inline void turns_of(const Forcing *forcing, int count, double t, Complex *turn) {
    for (int i = 0; i < count; i++) {
        bool known = i > 0 && forcing[i].frequency == forcing[0].frequency;
        turn[i] = known ? turn[0] : complex_rect(1.0, forcing[i].frequency * t);
    }
}

/* The motion from displacement `y0` [m] and rate `u0` [m/s] on under `forcings` <= FORCINGS forcings.
 *
 * Slow forcing of a slow oscillator, both compared with `fastest` [rad/s], is followed from rest too.
 * Samples are valid up to LONGEST_ARC / fastest. `oscillator` must outlive the motion. */
void forced_oscillator_begin(ForcedOscillator *motion, const Oscillator *oscillator,
                             double constant, double slope, const Forcing *forcing, int forcings,
                             double y0, double u0, double fastest);

/* Displacement and rate at `t` >= 0 [s]; `turn` as in a Sample. */
Response forced_oscillator_response(const ForcedOscillator *motion, double t, const Complex *turn);

/* Motion at `t` >= 0 [s]. The energy of the free part never grows, so that at `t` bounds it later. */
Sample forced_oscillator_sample(const ForcedOscillator *motion, double t);

/* Bounds on |displacement| and |rate| while samples are taken; infinite without a steady response. */
Response forced_oscillator_reach(const ForcedOscillator *motion);

#endif
