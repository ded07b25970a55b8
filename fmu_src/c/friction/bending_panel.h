/* Sliding while a bristle bends, in one panel: LuGre friction by Picard iteration.
 *
 * Within a contact mode the motion under Coulomb friction is linear. While bristles are not fully bent, LuGre friction
 * differs from that. With s, E and F as in taylor_slide.h, beta = (mu - s g_r) / mu, L the friction limit and rho =
 * sigma_1 / sigma_0, the difference is a force on the slider
 *
 *   f = s beta L (E + rho E') = a + b',   a = s beta (L - rho L') E,   b = s beta rho L E
 *
 * that dies out after a short path. E at Gauss nodes follows from the path under full friction and the change of that
 * path by f, computed with the E of the previous iterate. Each correction reduces the error by about the ratio of f to
 * the force that moves the slider. After the panel the motion is that under full friction with another momentum and
 * another free oscillation, in closed form up to the next stop.
 *
 * A panel is used where it is guaranteed to end before the next stop, and where the error that it turns out to have is
 * below the tolerance; series are used elsewhere. */
#pragma once

#include "bending_kernels.h"
#include "system.h"

/* How to follow a bending bristle: in one panel; as sliding under full friction, where f changes the velocity by less
 * than the tolerance; or by series otherwise. */
typedef enum { BY_PANEL, AS_BENT, BY_SERIES } BendingMotion;

/* `slide` is the motion after the panel, whose length is `length` [s], 0 for none; it holds up to `reach` [s]. Of f are
 * kept: a (`even`) [N] and b (`late`) [N s] at the points, b at the start (`first`) [N s], and the displacement that f
 * leaves beyond that of the `slide` (`offset`) [m]. `exponent` is k |x - x_r| at the points, with `rate` k [1/m].
 * `power` is that of friction at the nodes [W], `work` what friction does in the panel beyond what it would do on the
 * `slide` [J]. */
typedef struct {
    SplitSlide slide;
    BendingKernels *kernels;
    double length, reach, rate, scale, lag, first, offset, work;
    double exponent[POINTS], even[POINTS], late[POINTS], power[GAUSS_NODES];
} BendingPanel;

/* Begin motion in contact from `now` on in `direction`, that of its velocity or, from rest, of its acceleration, for up
 * to `longest` [s]. Return how to follow it; the panel is set up for BY_PANEL only. The error of the velocity is about
 * `tolerance` [m/s]. The tables of the system must outlive the panel, and serve one panel at a time; without any,
 * series alone are used. */
BendingMotion bending_panel_begin(BendingPanel *panel, const System *system, int direction, const Moment *now,
                                  const Phasors *start, double longest, double tolerance);

/* Begin motion under full friction, flight, or the rest of a held plant, without a panel. */
void bending_panel_skip(BendingPanel *panel, const Split *split, const Plant *plant, int direction, const Moment *now,
                        const Phasors *start);

/* Find the work of friction in the panel; until then it is 0. */
void bending_panel_weigh(BendingPanel *panel);

/* Displacement [m] of the slider and work of friction [J] after `t` [s]. */
Passage bending_panel_passage(const BendingPanel *panel, double t);

/* Where the motion is after `t` [s], not before the end of the panel. */
Place bending_panel_place(const BendingPanel *panel, double t);
