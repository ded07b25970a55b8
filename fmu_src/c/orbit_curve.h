/* Held orbits over the slow velocity, under one lead of the normal load: tabulated, lazily.
 *
 * Between the grazing velocities, beyond which the slider never turns back, all is smooth in the angle chi
 * of V = middle + reach cos(chi): polynomials on panels in chi, with more nodes until they hold, or halved. Beyond,
 * friction and its answer stay as they are. A panel is made when it is first asked for, always from the
 * same start: what it says does not depend on what was asked before. */
#ifndef SLIDER_ORBIT_CURVE_H
#define SLIDER_ORBIT_CURVE_H

#include <stdbool.h>

#include "held_orbit.h"
#include "orbit_shifts.h"
#include "panel_series.h"
#include "period_map.h"

/* Panels that a curve keeps. */
enum { CURVE_PANELS = 32 };

/* Base panels of a curve, most halvings of one, and of one in which an orbit is missing; and bytes with a bit
 * for each panel. */
enum { BASE_PANELS = 4, MAX_DEPTH = 6, MAX_DEPTH_MISSING = 2 };
enum { ASKED_BYTES = BASE_PANELS * ((2 << MAX_DEPTH) - 1) / 8 + 1 };

/* What is tabulated: mean friction F2 [N], 1 + kappa_m; at the section w1 [m/s], its integral over time [m]
 * of zero mean, and resonator [m, m/s] and bristle. */
typedef enum {
    ORBIT_FRICTION,
    ORBIT_FACTOR,
    ORBIT_OFFSET,
    ORBIT_WAY,
    ORBIT_DISPLACEMENT,
    ORBIT_RATE,
    ORBIT_BRISTLE,
    ORBIT_QUANTITIES
} OrbitQuantity;

/* An orbit as tables have it, its section being that in `direction`; `found` is false where averages of
 * first order stand for it, `beyond` true where the slider never turns back. */
typedef struct {
    double of[ORBIT_QUANTITIES];
    int direction;
    bool found, beyond;
} OrbitPoint;

/* Chebyshev coefficients over the panel `index` of 2^depth = `parts` in which each base panel is halved, of
 * each quantity the first `terms` that are not rounding, an even number. `holds` is false where it has to be halved,
 * `found` where an orbit is missing. `maps` is how often a period was mapped for it. */
typedef struct {
    bool known, found, holds;
    int depth, index, direction, maps;
    int terms[ORBIT_QUANTITIES];
    double parts;
    double coefficient[ORBIT_QUANTITIES][ORBIT_NODES];
} OrbitPanel;

/* The curve of a device under `waves` of the normal load in a turn, repeating after `turns`, at one lead.
 * `found` is false where there are no orbits. `beyond` [0] is backward, [1] forward. `asked` has a bit for each
 * panel, of all depths, that the ride of number `ride` has asked for, and `recent` is the one it was given last. */
typedef struct {
    bool known, found, combined;
    long used;
    Device device;
    double waves, lead;
    int turns;
    double middle, reach;
    OrbitPoint beyond[2];
    int next;
    long ride;
    unsigned char asked[ASKED_BYTES];
    const OrbitPanel *recent;
    OrbitPanel panel[CURVE_PANELS];
    ShiftPoint shifts[SHIFT_POINTS];
} OrbitCurve;

/* What w1 adds to the way at the section, its mean over a period being 0 [m]; false where a map fails. */
bool orbit_way(const PeriodMap *map, const HeldOrbit *orbit, double *way);

/* An orbit as tables have it, but for its way. */
OrbitPoint orbit_section_point(const PeriodMap *map, const HeldOrbit *orbit);

/* An orbit as tables have it; false where a map fails. */
bool orbit_point_of(const PeriodMap *map, const HeldOrbit *orbit, OrbitPoint *point);

/* Begin the curve of a map: its grazing velocities and what is beyond them. */
void orbit_curve_begin(OrbitCurve *curve, const PeriodMap *map, double lead);

/* Begin the panel `index` at a depth; its coefficients are 0. */
void orbit_panel_begin(OrbitPanel *panel, int depth, int index);

/* Count the terms of a panel. */
void orbit_panel_end(OrbitPanel *panel);

/* The quantity on a panel, at `place` = chi / pi BASE_PANELS. */
double orbit_panel_at(const OrbitPanel *panel, OrbitQuantity quantity, double place);

#endif
