/* Motion as a Taylor series in time: rest; sliding on bending bristles; sliding and flight under a normal frequency
 * that grows, and where the closed form would lose digits. At rest friction is the force that holds the slider.
 *
 * With s the direction of sliding, g = sigma_0 z the friction of the bristle and g_r its value where this series
 * starts, the bristle is a function of the path d = |x - x_r| alone (eq. 8):
 *
 *   g = s mu + (g_r - s mu) E,    E = exp(-sigma_0 d / mu),    E' = -(sigma_0 / mu) |v| E
 *   F = faces N (g_r + (mu - s g_r) (s (1 - E) + E sigma_1 v / mu))
 *
 * so no stiff state remains, and deep presliding, where g_r and 1 - E are small, loses no digits. The Taylor
 * coefficients of all factors follow by recurrence. */
#pragma once

#include <stddef.h>

#include "../device/split_slide.h"
#include "bristle.h"

/* Order of the series: close to the cheapest one at any tolerance. */
enum { TAYLOR_ORDER = 22, TAYLOR_TERMS = TAYLOR_ORDER + 1 };

/* A watched signal, `sign` times a series, and the bound of its curvature. */
typedef struct {
    const double *coefficients;
    double sign, bound;
} TaylorSignal;

/* Taylor coefficients of the slider's velocity, of the resonator's `displacement` and velocity (`rate`), of the
 * friction `force` [N] and, at rest, of the `margin` by which it is below its limit, forwards and backwards; they hold
 * up to `reach` [s]. `least` [N] is the smallest limit. */
typedef struct {
    int direction;
    bool rests, resonates;
    double velocity[TAYLOR_TERMS], displacement[TAYLOR_TERMS], rate[TAYLOR_TERMS];
    double force[TAYLOR_ORDER], margin[2][TAYLOR_TERMS];
    double reach, least;
    TaylorSignal watched[2];
} TaylorSlide;

/* Motion from `now` on, up to `reach`: in `direction`, or in flight in contact mode LIFTED; at rest in contact with
 * direction 0.
 *
 * `bristle` is NULL for full friction, and `start` are the phasors at the start. At `reach` the last terms of the
 * series are `tolerance` times the scale of velocities or, in a motion much slower than that, times its velocity. */
void taylor_slide_begin(TaylorSlide *slide, const Plant *plant, const Bristle *bristle, int direction,
                        const Moment *now, const Phasors *start, double tolerance);

/* As split_slide_departure, by a bound for up to `horizon` [s]. */
double taylor_slide_departure(const TaylorSlide *slide, double horizon);

/* Whether the motion begins in its direction, or stays at rest. */
bool taylor_slide_departs(const TaylorSlide *slide);

/* Watch the velocity in the direction of sliding, unless that is 0; at rest the forward, then the backward margin,
 * unless the force is 0 or always below the smallest limit. For up to `horizon` [s]. Return the number of watches. */
int taylor_slide_watches(TaylorSlide *slide, double horizon, Watch watches[2]);

/* Where the motion is after `t` [s], the work of friction included if it counts. */
Place taylor_slide_place(const TaylorSlide *slide, double t, bool counts_work);
