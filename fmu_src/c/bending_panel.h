/* Sliding while a bristle bends, all of it in one panel: LuGre friction by Picard iteration.
 *
 * Within a contact mode the motion is linear, but for what bristles that are not fully bent yet take from
 * Coulomb friction. With s, E and F as in taylor_slide.h, beta = (mu - s g_r) / mu, L the friction limit
 * and rho = sigma_1 / sigma_0 that is a force on the slider
 *
 *   f = s beta L (E + rho E') = a + b',   a = s beta (L - rho L') E,   b = s beta rho L E
 *
 * that dies out after a short path. E at Gauss nodes follows from the path under full friction and its
 * change by f, which is integrated with E as it was before: each correction leaves an error smaller by
 * about f over the force that moves the slider. After the panel the motion is that under full friction
 * with another momentum and another free oscillation, in closed form up to the next stop.
 *
 * A panel serves where it ends surely before the next stop, and where its estimated error is below the
 * tolerance. Elsewhere series do. */
#ifndef SLIDER_BENDING_PANEL_H
#define SLIDER_BENDING_PANEL_H

#include <stdbool.h>

#include "bending_kernels.h"
#include "bending_outlook.h"
#include "bristle.h"
#include "held.h"
#include "moment.h"

/* What f has given to the motion up to some time: displacement [m], velocity [m/s] and amplitude of the
 * resonator [m] of what goes on from the start of the panel. */
typedef struct {
    double offset, momentum;
    Complex swing;
} Given;

/* `slide` is the motion from the end of the panel on, which lasts `length` [s]; it holds for `reach` [s].
 * Of f, given in `all`, `even` a [N] and `late` b [N s] are kept at the points, and b at the start. */
typedef struct {
    SplitSlide slide;
    BendingKernels *kernels;
    double length, reach, rate, scale, lag, first;
    double even[MAX_ROW], late[MAX_ROW];
    Given all;
} BendingPanel;

/* Motion in contact from `now` on in `direction`, that of its velocity or, from rest, of its
 * acceleration, for up to `longest` [s]; set up where it goes on BY_PANEL. The error of the velocity
 * is about `tolerance` [m/s]. The tables must outlive the panel, and serve one at a time. */
BendingMotion bending_panel_begin(BendingPanel *panel, BendingTables *tables, const Held *held,
                                  const Bristle *bristle, int direction, const Moment *now,
                                  const Phasors *start, double longest, double tolerance);

/* Displacement of the slider after `t` [s], in m. */
double bending_panel_travel(const BendingPanel *panel, double t);

/* State after `t` [s]; displacement [m] and phasors as of a slide. */
State bending_panel_end(const BendingPanel *panel, double t, double *travel, KnownPhasors *known);

#endif
