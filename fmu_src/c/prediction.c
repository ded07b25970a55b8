#include "prediction.h"

#include <math.h>
#include <stddef.h>

#include "friction_law.h"
#include "orbit_motion.h"
#include "orbit_ride.h"
#include "steady_orbit.h"
#include "vibrating_load.h"

/* Largest difference, in fast velocities, between steady velocities of first and second order that belong
 * to the same balance. */
#define SAME 0.05

/* Whether friction is monotonic in the slow velocity, so that there is one balance. */
static bool is_monotonic(const Law *law, const PeriodMap *map) {
    const Device *device = &law->device;
    double drag = law->friction->averaged->drag(&law->bristle, map->speed);
    return device->normal_amplitude <= device->normal_preload && drag <= law->bristle.coefficient;
}

/* The steady motion: found from the velocity of first order, or else by a search over all velocities. */
static OrbitStatus find_steady(const Law *law, const PeriodMap *map, double lead, double velocity,
                               HeldOrbit *orbit) {
    double load = law->inputs.load;
    if (is_monotonic(law, map) &&
        held_orbit_at(map, lead, velocity, NULL, orbit) == ORBIT_FOUND &&
        steady_orbit_at(map, lead, load, orbit, orbit) == ORBIT_FOUND &&
        fabs(orbit->velocity - velocity) <= SAME * map->speed &&
        held_orbit_check_stable(map, orbit) == ORBIT_FOUND) {
        return ORBIT_FOUND;
    }
    return steady_orbit(map, lead, load, orbit);
}

Averaged prediction_of(const Law *law, double normal_lead) {
    const Device *device = &law->device;
    Averaged prediction = averaged(law, normal_lead);
    SlowPhase slow = orbit_phase_of(law);
    bool repeats = turns_to_repeat(device, law->inputs.frequency_ratio, EXACT) > 0;
    if (device->averaging_order == 2 && device->fidelity == 0 && law->resolved == NULL) {
        prediction.valid = false;
    }
    if (device->averaging_order < 2 || !prediction.valid ||
        !(repeats || device->normal_amplitude == 0.0)) {
        return prediction;
    }
    if (slow.turns == 0) {
        prediction.valid = false;
        return prediction;
    }
    PeriodMap map;
    HeldOrbit steady, blocked;
    Refusal refusal;
    double lead = law->inputs.phase + normal_lead, force;
    prediction.valid =
        period_map_prepare(&map, device, slow.waves, slow.turns, &refusal) &&
        find_steady(law, &map, lead, prediction.steady_velocity, &steady) == ORBIT_FOUND &&
        blocking_orbit(&map, lead, &blocked, &force) == ORBIT_FOUND;
    if (prediction.valid) {
        Law shaken = *law;
        shaken.fast = map.fast;
        prediction.valid =
            has_slow_motion(&shaken) || (is_unique(&map, &steady) && is_unique(&map, &blocked));
    }
    if (prediction.valid) {
        prediction.steady_velocity = steady.velocity;
        prediction.blocking_force = force;
    }
    return prediction;
}
