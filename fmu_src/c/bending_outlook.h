/* Whether one panel serves for sliding while a bristle bends: what can be told before anything is
 * integrated. */
#ifndef SLIDER_BENDING_OUTLOOK_H
#define SLIDER_BENDING_OUTLOOK_H

#include <stdbool.h>

#include "bristle.h"
#include "held.h"
#include "moment.h"

/* `rate` k [1/m] of E = exp(-k |x - x_r|), `lag` rho [s], `bend` beta; `push` bounds the acceleration by
 * the force f of the bristle [m/s^2]; `speed` [m/s], `acceleration` [m/s^2] and `jerk` [m/s^3] under full
 * friction are counted in the direction of sliding, and `contraction` is f over what moves the slider
 * otherwise. Once E = exp(-`exponent`), after about `length` [s], what f still gives to the velocity is
 * below the tolerance. A path that `starts_slow` is rather parabolic than linear in time. */
typedef struct {
    double rate, lag, bend, push, speed, acceleration, jerk, contraction, exponent, length;
    bool starts_slow;
} BendingOutlook;

/* How to follow bending bristles: in one panel; as sliding under full friction, where they change the
 * velocity by less than the tolerance; or by series, where neither serves. */
typedef enum { BY_PANEL, AS_BENT, BY_SERIES } BendingMotion;

/* Motion in contact from `now` on in `direction`, that of its velocity or, from rest, of its acceleration;
 * it goes on for up to `longest` [s]. `tolerance` in m/s. */
BendingMotion bending_outlook(BendingOutlook *outlook, const Held *held, const Bristle *bristle,
                              int direction, const Moment *now, const Phasors *phasors,
                              double longest, double tolerance);

/* Bound on how f, over its length [s], changes the velocity [m/s]. */
double bending_weight(const BendingOutlook *outlook, double length);

/* Nodes for a panel of this length [s] that `ends_within` it or not; 0 where too many would be needed. */
int bending_nodes(const BendingOutlook *outlook, double length, bool ends_within, double tolerance);

/* Whether the slider surely goes on for `length` [s] without a stop. */
bool bending_goes_on(const BendingOutlook *outlook, const SplitSlide *slide, double length);

/* The estimated error of the velocity [m/s] by what interpolation at the nodes misses, as a `share` of f:
 * at the end of the panel, or if it `ends_within` there. */
double bending_error(double weight, double share, double contraction, int nodes, bool ends_within);

#endif
