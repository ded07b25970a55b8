#include "steady_orbit.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "state.h"

/* Velocities at which orbits tell where steady motion is, and the most halvings in between. */
enum { SAMPLES = 12, MAX_HALVINGS = 60 };

/* Largest sampled velocity, in v_q: beyond grazing unless friction is strong. */
#define SAMPLED_REACH 1.05

/* What lies between two velocities [m/s], at the first of which friction and load together drive the
 * slider on, and at the second brake it. `orbit` is one of them. */
typedef struct {
    double low, high;
    HeldOrbit orbit;
} Bracket;

/* Finds the steady motion in a bracket: by the tangent, or else between the halves. */
static OrbitStatus refine(const PeriodMap *map, double lead, double load, Bracket *bracket,
                          HeldOrbit *orbit) {
    OrbitStatus status = ORBIT_NOT_CONVERGED;
    for (int halving = 0; halving < MAX_HALVINGS; halving++) {
        status = steady_orbit_at(map, lead, load, &bracket->orbit, orbit);
        if (status == ORBIT_FOUND && bracket->low <= orbit->velocity &&
            orbit->velocity <= bracket->high) {
            return status;
        }
        double middle = 0.5 * (bracket->low + bracket->high);
        status = held_orbit_at(map, lead, middle, &bracket->orbit, &bracket->orbit);
        if (status != ORBIT_FOUND) {
            return status;
        }
        *(bracket->orbit.friction + load > 0.0 ? &bracket->high : &bracket->low) = middle;
    }
    return ORBIT_NOT_CONVERGED;
}

OrbitStatus steady_orbit(const PeriodMap *map, double lead, double load, HeldOrbit *orbit) {
    double sliding = sliding_friction(map, lead);
    double before = -INFINITY, at_before = load - sliding;
    bool known = false;
    int steady = 0;
    OrbitStatus status, failure = ORBIT_RUNS_AWAY;
    HeldOrbit sample;
    Bracket bracket = {0};
    for (int i = 0; i <= SAMPLES; i++) {
        double velocity = -SAMPLED_REACH * map->speed * cos(PI * (i + 0.5) / SAMPLES);
        double excess = load + sliding;
        if (i == SAMPLES) {
            velocity = INFINITY;
        } else {
            status = held_orbit_at(map, lead, velocity, known ? &sample : NULL, &sample);
            if (status != ORBIT_FOUND) {
                failure = status;
                known = false;
                continue;
            }
            known = true;
            excess = load + sample.friction;
        }
        if (at_before < 0.0 && excess >= 0.0) {
            steady++;
            bracket.low = before;
            bracket.high = velocity;
            bracket.orbit = sample;
        }
        before = velocity;
        at_before = excess;
    }
    if (steady != 1) {
        return steady == 0 ? failure : ORBIT_UNDETERMINED;
    }
    double reach = 2.0 * SAMPLED_REACH * map->speed;
    bracket.low = fmax(bracket.low, -reach);
    bracket.high = fmin(bracket.high, reach);
    return refine(map, lead, load, &bracket, orbit);
}

OrbitStatus blocking_orbit(const PeriodMap *map, double lead, HeldOrbit *orbit, double *force) {
    OrbitStatus status = held_orbit_at(map, lead, 0.0, NULL, orbit);
    *force = status == ORBIT_FOUND ? -orbit->friction : 0.0;
    return status;
}
