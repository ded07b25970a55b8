#include "orbit_shifts.h"

#include "elementary.h"
#include <stddef.h>

#include "orbit_equations.h"
#include "state.h"

/* Decay of the slow motion in a period from which on the expansion in the excess is cut off, as next to
 * grazing, where it has no sense. */
#define TOO_STEEP 2.0

/* Share of a time that measuring and interpolating it leave unsure. Terms of third order are those of second by the
 * decay of the slow motion in a period. */
#define UNSURE 0.1

/* Change of velocity, in the scale of velocities, for derivatives. */
#define STEP 1e-3

/* An orbit, and another with more velocity, from which derivatives by v come. */
typedef struct {
    OrbitProbe here;
    OrbitLinearisation there;
    OrbitPassage after;
    HeldOrbit orbit;
    double step, section_by_velocity;
} Neighbours;

static bool find_neighbours(const PeriodMap *map, double lead, double velocity, Neighbours *found) {
    HeldOrbit *here = &found->orbit, there;
    double step = velocity > 0.0 ? -STEP : STEP;
    found->step = step;
    if (held_orbit_at(map, lead, velocity, NULL, here) != ORBIT_FOUND ||
        held_orbit_linearise(map, here) != ORBIT_FOUND || !orbit_probe(map, here, &found->here) ||
        held_orbit_at(map, lead, velocity + step * map->speed, here, &there) != ORBIT_FOUND ||
        held_orbit_linearise(map, &there) != ORBIT_FOUND || there.sticks ||
        !linearise_orbit(there.jacobian, map->states, &found->there) || !found->there.is_slow ||
        !orbit_pass(map, &there, &found->there, 0.0, &found->after)) {
        return false;
    }
    found->section_by_velocity = (found->after.section - found->here.passage.section) / step;
    return true;
}

static OrbitBend bend_of(const Neighbours *found, int states) {
    const OrbitLinearisation *here = &found->here.linear, *there = &found->there;
    OrbitBend bend = {.slope = (there->slope - here->slope) / found->step,
                      .factor = (there->factor - here->factor) / found->step};
    for (int i = 0; i < states; i++) {
        bend.tangent[i] = (there->tangent[i] - here->tangent[i]) / found->step;
        bend.lag[i] = (there->lag[i] - here->lag[i]) / found->step;
    }
    return bend;
}

/* By how much V is ahead at the phases, in periods; and the largest of the times by which single turns differ. */
static double lags_of(const Neighbours *found, int turns, double lag[LAG_PHASES]) {
    const OrbitProbe *here = &found->here;
    const OrbitLinearisation *linear = &here->linear;
    double decay = linear->factor * linear->slope, way[LAG_PHASES], largest = 0.0;
    for (int i = 0; i < LAG_PHASES; i++) {
        double n = here->since[i], moved = velocity_by_excess(linear, n);
        double by = (found->after.momentum[i] - here->passage.momentum[i]) / found->step;
        double way_by = (found->after.way[i] - here->passage.way[i]) / found->step;
        double travelled = decay == 0.0 ? -0.5 * linear->factor * n * n
                                        : (-linear->factor * n - moved) / decay;
        lag[i] = -(here->by_excess.momentum[i] - by * moved) / (by * linear->factor);
        way[i] = here->by_excess.way[i] - travelled - way_by * moved;
    }
    for (int i = 0; i < LAG_PHASES && turns > 1; i++) {
        int turn = (LAG_PHASES + turns / 2) / turns;
        largest = fmax(largest, fabs(way[(i + turn) % LAG_PHASES] - way[i]));
    }
    return turns * largest / linear->factor;
}

void shift_point_make(ShiftPoint *point, const PeriodMap *map, double lead, double middle,
                      double reach, int index) {
    double chi = (index + 0.5) * PI / SHIFT_POINTS, h, lag[LAG_PHASES];
    Neighbours found;
    *point = (ShiftPoint){.known = true};
    if (!find_neighbours(map, lead, middle + reach * cos(chi), &found)) {
        return;
    }
    OrbitBend bend = bend_of(&found, map->states);
    if (!orbit_defect(map, &found.orbit, &found.here, &bend, &h)) {
        return;
    }
    const OrbitLinearisation *linear = &found.here.linear;
    double f = linear->factor, steepness = f * linear->slope / TOO_STEEP, squared = steepness * steepness;
    double counts = map->period / (1.0 + squared * squared);
    double unsure = UNSURE + fabs(f * linear->slope);
    point->of[SHIFT_GAINED] = counts * h / (f * f) * reach / map->speed * sin(chi);
    point->of[SHIFT_SHOWN] = counts * found.section_by_velocity;
    point->of[SHIFT_OF_TURN] = counts * lags_of(&found, map->turns, lag);
    point->of[SHIFT_UNSURE] = fmin(unsure, 1.0);
    point->of[SHIFT_ADDED_MASS] = f - 1.0;
    double lagging = hypot(linear->lag[1], linear->lag[2]) * map->swing / map->speed;
    point->of[SHIFT_SWING] = lagging * map->period / f;
    for (int k = 0; k < LAG_PHASES; k++) {
        point->of[SHIFT_LAG + k] = counts * lag[k] + point->of[SHIFT_SHOWN];
    }
    point->measured = true;
    for (int shift = 0; shift < ORBIT_SHIFTS; shift++) {
        point->measured = point->measured && isfinite(point->of[shift]);
    }
}
