/* What the slow equation leaves out, to second order in the excess force, measured on the period map.
 *
 * In the scales of the period map, E being the excess F2 + load of force, true slow motion is v' = -f E + h E^2
 * with states x = x*(v) + xi E + eta E^2 and the mean velocity v; f is the factor 1 + kappa_m. The states a
 * period later are those that v has then:
 *
 *   (P_x - rho^2) eta - (x_v + F2' xi) rho k h = S - P_2,     X_x eta - k^2 h / 2 = s - X_2
 *
 * P_2 and X_2 are the squares that the map of x* + xi E under E has, S and s those of the slow equation
 * without h, and k = (rho - 1) / ln(rho). */
#ifndef SLIDER_ORBIT_DEFECT_H
#define SLIDER_ORBIT_DEFECT_H

#include <stdbool.h>

#include "held_orbit.h"
#include "orbit_linearisation.h"

/* Drive phases in a period, from 0 on, at which the motion is looked at. */
enum { LAG_PHASES = 8 };

/* A motion through a period: at these phases W and the slider's way less that of v since the section; where its
 * section is from the mean place of the pair's centre, whose share of the vibration is left out; the values that
 * the map has. In the scales of the period map. */
typedef struct {
    double momentum[LAG_PHASES], way[LAG_PHASES], section;
    double values[UNKNOWNS];
} OrbitPassage;

/* A linearised orbit: its passage, what the excess adds to that, and its squares in the map's values. `since` is
 * the part of a period from the section to the phases. */
typedef struct {
    OrbitLinearisation linear;
    OrbitPassage passage, by_excess;
    double since[LAG_PHASES], squares[UNKNOWNS];
} OrbitProbe;

/* Derivatives by v. */
typedef struct {
    double slope, factor;
    double tangent[UNKNOWNS], lag[UNKNOWNS];
} OrbitBend;

/* Pass through the orbit, the `excess` times its lag off it. False where a map fails. */
bool orbit_pass(const PeriodMap *map, const HeldOrbit *orbit, const OrbitLinearisation *linear,
                double excess, OrbitPassage *passage);

/* Probe a linearised orbit by three maps. False where one fails, where the slider sticks, and where its
 * motion is not slow. */
bool orbit_probe(const PeriodMap *map, const HeldOrbit *orbit, OrbitProbe *probe);

/* Find `h` of a probed orbit; false where there is none. */
bool orbit_defect(const PeriodMap *map, const HeldOrbit *orbit, const OrbitProbe *probe,
                  const OrbitBend *bend, double *h);

/* The velocity that a unit of excess adds in `n` periods, and the integral of exp(-decay t) up to n. */
double velocity_by_excess(const OrbitLinearisation *linear, double n);
double decayed_integral(double decay, double n);

#endif
