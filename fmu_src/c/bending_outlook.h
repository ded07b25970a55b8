/* Estimates, made before any integration, that decide whether one panel can follow a bending bristle. */
#ifndef SLIDER_BENDING_OUTLOOK_H
#define SLIDER_BENDING_OUTLOOK_H

#include <stdbool.h>

#include "bristle.h"
#include "held.h"
#include "moment.h"

/* `rate` k [1/m] of E = exp(-k |x - x_r|), `lag` rho [s], `bend` beta; `push` bounds the acceleration by
 * the force f of the bristle [m/s^2]; `speed` [m/s], `acceleration` [m/s^2] and `jerk` [m/s^3] are those
 * under full friction, in the direction of sliding; `contraction` is the ratio of f to the force that moves
 * the slider. From E = exp(-`exponent`) on, after about `length` [s], f changes the velocity by less than
 * the tolerance. Where the motion `starts_slow` its path is closer to a parabola than to a line. */
typedef struct {
    double rate, lag, bend, push, speed, acceleration, jerk, contraction, exponent, length;
    bool starts_slow;
} BendingOutlook;

/* How to follow a bending bristle: in one panel; as sliding under full friction, where f changes the
 * velocity by less than the tolerance; or by series otherwise. */
typedef enum { BY_PANEL, AS_BENT, BY_SERIES } BendingMotion;

/* Choose for motion in contact from `now` on in `direction`, that of its velocity or, from rest, of its
 * acceleration, for up to `longest` [s]. `tolerance` is the error allowed in the velocity [m/s]. Where the
 * choice is BY_SERIES, `outlook` may be incomplete. */
BendingMotion bending_outlook(BendingOutlook *outlook, const Held *held, const Bristle *bristle,
                              int direction, const Moment *now, const Phasors *phasors,
                              double longest, double tolerance);

/* Bound on the change of the velocity [m/s] by f over a panel of this length [s]. */
double bending_weight(const BendingOutlook *outlook, double length);

/* Number of nodes for a panel of this length [s]; 0 where more than MAX_NODES would be needed. `ends_within`:
 * the motion may end within the panel. */
int bending_nodes(const BendingOutlook *outlook, double length, bool ends_within, double tolerance);

/* Whether the slider is guaranteed not to stop for `length` [s]. */
bool bending_goes_on(const BendingOutlook *outlook, const SplitSlide *slide, double length);

/* Estimate of the error of the velocity [m/s] by interpolation between the nodes, which misses a `share` of
 * f: at the end of the panel, or with `ends_within` at any time in it. */
double bending_error(double weight, double share, double contraction, int nodes, bool ends_within);

#endif
