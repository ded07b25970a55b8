#include "orbit_bend.h"

#include "elementary.h"
#include <stddef.h>

#include "held_orbit.h"
#include "orbit_ride.h"
#include "resolved_start.h"
#include "slow_motion_error.h"
#include "state.h"

double orbit_bend_decay(const Law *law, double lead, const Moment *moment) {
    if (!bend_is_slow(law)) {
        return INFINITY;
    }
    const SlowPhase slow = orbit_phase_of(law);
    const PeriodMap *map = orbit_map_of(law->orbits, &law->device, &slow);
    double velocity = momentum_velocity(map, &moment->state, moment->theta);
    HeldOrbit orbit;
    if (held_orbit_at(map, lead, velocity, NULL, &orbit) != ORBIT_FOUND ||
        held_orbit_linearise(map, &orbit) != ORBIT_FOUND) {
        return INFINITY;
    }
    /* The multiplier may be that of the resonator. */
    return fmax(-log(orbit.fast_multiplier) / map->turns, min_bend_decay(law));
}

double velocity_of_bend(const Law *law, double decay, double angle) {
    if (isinf(decay)) {
        return 0.0;
    }
    /* All friction, for as long as the bend takes to decay. */
    double impulse = TAU * friction_share(law) * law->fast.velocity / decay;
    return impulse * exp(-decay * angle / TAU);
}
