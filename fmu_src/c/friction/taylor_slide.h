/* Sliding or flight as a Taylor series in time: on bending bristles, under a normal frequency that grows, and where the
 * closed form would lose digits.
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

#include "../device/split_slide.h"
#include "bristle.h"

/* Order of the series: close to the cheapest one at any tolerance. */
enum { TAYLOR_ORDER = 22, TAYLOR_TERMS = TAYLOR_ORDER + 1 };

/* Taylor coefficients of the slider's velocity, of the resonator's `displacement` and velocity (`rate`), and of the
 * friction `force` [N]; they hold up to `reach` [s]. `bound` is that of the watched curvature. */
typedef struct {
    int direction;
    bool resonates;
    double velocity[TAYLOR_TERMS], displacement[TAYLOR_TERMS], rate[TAYLOR_TERMS], force[TAYLOR_ORDER];
    double reach, bound;
} TaylorSlide;

/* Motion in contact from `state` on, in `direction`, up to `reach`.
 *
 * `friction` is sigma_0 z and `start` are the phasors at the start. At `reach` the last terms of the series are
 * `tolerance` times `scale` [m/s] or, in a motion that is much slower than that, times its velocity. */
void taylor_slide_begin(TaylorSlide *slide, const Plant *plant, const Bristle *bristle, int direction,
                        const State *state, double friction, const Phasors *start, double tolerance, double scale);

/* Whether the motion begins in its direction, or stays at rest. */
bool taylor_slide_departs(const TaylorSlide *slide);

/* The velocity in the direction of sliding, up to `horizon` [s]. */
Watch taylor_slide_watch(TaylorSlide *slide, double horizon);

/* Displacement [m] of the slider and, if it counts, work of friction [J] after `t` [s]. */
Passage taylor_slide_passage(const TaylorSlide *slide, double t, bool counts_work);

/* State after `t` [s]. */
State taylor_slide_state(const TaylorSlide *slide, double t);
