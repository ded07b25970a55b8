/* Held orbits of the native component, for tests: numbers in, numbers out. */
#include <stdbool.h>
#include <stddef.h>

#include "orbit_drift.h"
#include "steady_orbit.h"
#include "values.h"

enum { HELD, STEADY, NUMBERS = 15, STATES = 4 };

static bool map_of(PeriodMap *map, const double *values, double ratio, int turns) {
    Device device = device_of(values);
    Refusal refusal;
    return period_map_prepare(map, &device, ratio, turns, &refusal);
}

/* The orbit under what is `given`: the velocity, from a neighbour and linearised, or the load. `excess` is the
 * force by which motion through `theta` drifts. Returns its status, or -1 for a device without period
 * map. */
int find_orbit(const double *values, double ratio, int turns, double lead, int kind, double given,
               double neighbour, double excess, double theta, double *numbers) {
    PeriodMap map;
    HeldOrbit first, orbit;
    Moment moment;
    OrbitStatus status;
    if (!map_of(&map, values, ratio, turns)) {
        return -1;
    }
    if (kind == HELD) {
        bool near = held_orbit_at(&map, lead, neighbour, NULL, &first) == ORBIT_FOUND;
        status = held_orbit_at(&map, lead, given, near ? &first : NULL, &orbit);
        status = status == ORBIT_FOUND ? held_orbit_linearise(&map, &orbit) : status;
    } else {
        status = steady_orbit(&map, lead, given, &orbit);
    }
    if (status != ORBIT_FOUND ||
        !held_orbit_moment(&map, &orbit, excess - orbit.friction, theta, &moment)) {
        return (int)status;
    }
    const double found[NUMBERS] = {
        orbit.velocity,
        orbit.friction,
        orbit.factor,
        orbit.slope,
        orbit.fast_multiplier,
        orbit.reversals,
        orbit.sticks,
        orbit.maps,
        moment.state.velocity,
        moment.state.displacement,
        moment.state.rate,
        moment.bristle,
        moment.position,
        held_orbit_offset(&map, &orbit, &moment),
        map.speed,
    };
    for (int i = 0; i < NUMBERS; i++) {
        numbers[i] = found[i];
    }
    return 0;
}

/* Resolved motion under `load` that drifts from the orbit at `velocity` on: position, velocity, displacement
 * and rate after each of `periods`, and at first. Returns 0 if it could be followed. */
int run_periods(const double *values, double ratio, int turns, double lead, double load,
                double velocity, int periods, double *states) {
    PeriodMap map;
    HeldOrbit orbit;
    Moment now, after;
    double position = 0.0;
    if (!map_of(&map, values, ratio, turns) ||
        held_orbit_at(&map, lead, velocity, NULL, &orbit) != ORBIT_FOUND ||
        held_orbit_linearise(&map, &orbit) != ORBIT_FOUND ||
        !held_orbit_moment(&map, &orbit, load, 0.0, &now)) {
        return 1;
    }
    for (int i = 0; i <= periods; i++) {
        const double state[STATES] = {position, now.state.velocity, now.state.displacement,
                                      now.state.rate};
        for (int k = 0; k < STATES; k++) {
            states[STATES * i + k] = state[k];
        }
        orbit_enter(&map, lead, 0.0, &now);
        if (!orbit_advance(&map, lead, load, &now, map.period, &after)) {
            return 1;
        }
        position += after.position;
        now = after;
    }
    return 0;
}
