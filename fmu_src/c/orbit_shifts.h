/* By how much time slow motion on held orbits is ahead of true motion: its error over its acceleration.
 *
 * The excess force E decays as V does: what the mean velocity errs by is the acceleration g = -f E / Mt times a time,
 * and under held inputs that time changes with V alone. It is measured at points of a curve in chi and
 * interpolated: a tenth is exact enough for an error. */
#ifndef SLIDER_ORBIT_SHIFTS_H
#define SLIDER_ORBIT_SHIFTS_H

#include <stdbool.h>

#include "orbit_defect.h"

/* Points of a curve, in the middle of as many equal parts in chi. */
enum { SHIFT_POINTS = 16 };

/* Times [s]: what is gained per chi by the slow equation, and from point to point by what mean velocity has
 * more than V; the most by which single turns of the drive differ in an orbit of several; by which mean
 * velocity is ahead of that of the motion with the same W, at LAG_PHASES. And the added
 * mass kappa_m, how far the resonator lags, over the acceleration [s^2],
 * and the share by which terms of higher order change these times. */
typedef enum {
    SHIFT_GAINED,
    SHIFT_SHOWN,
    SHIFT_OF_TURN,
    SHIFT_ADDED_MASS,
    SHIFT_SWING,
    SHIFT_UNSURE,
    SHIFT_LAG,
    ORBIT_SHIFTS = SHIFT_LAG + LAG_PHASES
} OrbitShift;

/* The shifts at a point; `measured` is false where the orbit cannot be probed. */
typedef struct {
    bool known, measured;
    double of[ORBIT_SHIFTS];
} ShiftPoint;

/* Measure the point `index` of the orbits at `lead` [rad] with V = middle + reach cos(chi). */
void shift_point_make(ShiftPoint *point, const PeriodMap *map, double lead, double middle,
                      double reach, int index);

#endif
