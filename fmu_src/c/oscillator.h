/* Closed forms of one damped oscillator, y'' + 2 decay y' + stiffness y = g(t).
 *
 * Every form stays regular: at and around critical damping, without damping, and when the forcing
 * frequency meets the damped one, where the usual particular solution is singular. */
#ifndef SLIDER_OSCILLATOR_H
#define SLIDER_OSCILLATOR_H

#include <stdbool.h>

#include "complex_number.h"

/* Share of the drive frequency below which an oscillator or a forcing counts as slow: its steady response
 * would be far larger than the response between two reversals. */
#define SLOW 0.02

/* The longest leg, as an angle [rad] of the fastest oscillation: avoids the rounding errors of large
 * arguments of sine and cosine. */
#define LONGEST_ARC 60.0

/* `decay` [1/s] and `stiffness` [1/s^2]; derived from these: the undamped `frequency` [rad/s] and, where
 * `oscillatory`, the `eigenvalue` [1/s] of positive imaginary part. */
typedef struct {
    double decay, stiffness, frequency;
    bool oscillatory;
    Complex eigenvalue;
} Oscillator;

/* Displacement (m or s^2 per unit forcing) and its rate, real or as complex amplitude. */
typedef struct {
    double displacement, rate;
} Response;

typedef struct {
    Complex displacement, rate;
} ComplexResponse;

Oscillator oscillator_of(double decay, double stiffness);

/* Steady response to exp(i frequency t), as a complex amplitude [s^2]. */
Complex transfer(const Oscillator *oscillator, double frequency);

/* Whether the particular solution at this frequency [rad/s] is too large to be split off. */
bool resonates(const Oscillator *oscillator, double frequency);

/* Decaying cosine C (in `displacement`) and sine S [s] (in `rate`) after t >= 0 [s]. From
 * displacement y and velocity u the free motion is y (C + decay S) + u S, its velocity u (C - decay
 * S) - stiffness y S. */
Response free_response(const Oscillator *oscillator, double t);

/* Response to exp(i frequency t) from rest; regular at resonance. Only for oscillatory damping and
 * frequency > 0. `free` is the free response and `turn` exp(i frequency t), both after t. */
ComplexResponse response_from_rest(const Oscillator *oscillator, double frequency, double t,
                                   Response free, Complex turn);

/* Response to a unit step from rest, without cancellation for soft oscillators; `free` as above. */
Response step_response(const Oscillator *oscillator, double t, Response free);

/* Response to a unit ramp from rest, likewise. */
Response ramp_response(const Oscillator *oscillator, double t, Response free);

/* Response to exp(i frequency t) from rest, by a power series, for t far below all periods. */
ComplexResponse slow_response_from_rest(const Oscillator *oscillator, double frequency, double t);

/* Integral of exp(i frequency s) over s from 0 to t [s], regular at frequency 0; `turn` is
 * exp(i frequency t). */
Complex exponential_integral(double frequency, double t, Complex turn);

/* Integral of (t - s) exp(i frequency s) over s from 0 to t [s^2], regular at frequency 0. */
Complex exponential_double_integral(double frequency, double t);

#endif
