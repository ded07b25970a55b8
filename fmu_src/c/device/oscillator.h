/* Closed forms of one damped oscillator, y'' + 2 decay y' + stiffness y = g(t).
 *
 * Free motion is regular at and around critical damping and without damping. */
#pragma once

#include <stdbool.h>

#include "../base/complex_number.h"

/* Share of the drive frequency below which an oscillator or a forcing counts as slow: its steady response would be far
 * larger than the response between two reversals, and lose as many digits. */
#define SLOW 0.02

/* The longest segment, as an angle [rad] of the fastest oscillation: avoids the rounding errors of large arguments of
 * sine and cosine. */
#define LONGEST_ARC 60.0

/* `decay` [1/s] and `stiffness` [1/s^2]; derived from these: the undamped `frequency` [rad/s] and, where `oscillatory`,
 * the `eigenvalue` [1/s] of positive imaginary part. */
typedef struct {
    double decay, stiffness, frequency;
    bool oscillatory;
    Complex eigenvalue;
} Oscillator;

/* Displacement [m] and its rate [m/s]. */
typedef struct {
    double displacement, rate;
} Response;

Oscillator oscillator_of(double decay, double stiffness);

/* Rate [1/s] at which free motion decays, the slower of two. */
double slower_decay(const Oscillator *oscillator);

/* Steady response to exp(i frequency t), as a complex amplitude [s^2]. */
Complex transfer(const Oscillator *oscillator, double frequency);

/* Whether the particular solution at this frequency [rad/s] is too large to be split off. */
bool resonates(const Oscillator *oscillator, double frequency);

/* Decaying cosine C (in `displacement`) and sine S [s] (in `rate`) after t >= 0 [s]. */
Response free_response(const Oscillator *oscillator, double t);

/* Free motion from `start` on, by the free response. */
static inline Response free_motion(const Oscillator *oscillator, Response start, Response free) {
    double y = start.displacement, u = start.rate, sway = oscillator->decay * free.rate;
    return (Response){y * (free.displacement + sway) + u * free.rate,
                      u * (free.displacement - sway) - oscillator->stiffness * y * free.rate};
}
