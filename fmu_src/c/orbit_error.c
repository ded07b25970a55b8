#include "orbit_error.h"

#include "elementary.h"
#include <stddef.h>

#include "orbit_drift.h"
#include "resolved_start.h"
#include "shift_tables.h"
#include "slow_motion_error.h"
#include "state.h"

/* Acceleration, over that by all friction, below which the motion has settled. */
#define SETTLED 1e-8

/* Error, over that of resolution, whose decay is not looked at once the motion has settled. */
#define NEGLIGIBLE_ERROR 1e-3

/* Difference of velocities, over the fast one, for the slope of the acceleration. */
#define SLOPE_STEP 1e-6

/* Decay of the resonator's swing in a turn that is seen in mean velocities of a turn. */
#define SEEN 1.0

static bool has_shifts(const OrbitRide *ride) {
    bool curve = ride->source == FROM_CURVE || ride->source == FROM_COMBINED;
    return curve && !is_ramped(&ride->law->held.plant) && !slow_phase_drifts(&ride->slow);
}

ErrorPlace error_place(OrbitRide *ride, double velocity, double theta) {
    const Plant *plant = &ride->law->held.plant;
    ErrorPlace place = {.velocity = velocity};
    double friction, factor;
    OrbitTables *tables = ride->law->orbits;
    if (!has_shifts(ride) ||
        !orbit_friction_at(tables, ride->curve, velocity, &friction, &factor)) {
        return place;
    }
    place.beyond = orbit_place(ride->curve, velocity) < 0.0;
    place.acceleration = -factor * (friction + plant->load) / plant->total_mass;
    double turns = theta / (TAU * ride->slow.turns);
    ShiftsThere shifts;
    place.measured =
        orbit_shifts_at(tables, ride->curve, velocity, turns - floor(turns), &shifts);
    if (!place.measured) {
        return place;
    }
    place.lag = shifts.lag;
    place.of_turn = shifts.of_turn;
    place.unsure = shifts.unsure;
    place.swing = fmax(shifts.swing, swing_by_inertia(ride->law));
    place.left_out = factor == 1.0 ? shifts.added_mass : 0.0;
    return place;
}

/* What the swing that resolved motion leaves adds to mean velocity [m/s], by the orbit that lags. */
static double error_of_swing(const OrbitRide *ride, double velocity, double theta,
                             const Moment *now) {
    const PeriodMap *map = ride->map;
    const Law *law = ride->law;
    HeldOrbit orbit;
    Moment there;
    if (held_orbit_at(map, ride->lead, velocity, NULL, &orbit) != ORBIT_FOUND ||
        held_orbit_linearise(map, &orbit) != ORBIT_FOUND ||
        !held_orbit_moment(map, &orbit, law->inputs.load, theta, &there)) {
        return 0.0;
    }
    double displacement = now->state.displacement - there.state.displacement;
    double rate = (now->state.rate - there.state.rate) / law->device.drive_frequency;
    return velocity_of_swing(law, hypot(displacement, rate));
}

/* No velocity errs by more than the vibration. */
static void bound(const Law *law, OrbitState *orbit) {
    double fast = law->fast.velocity;
    orbit->ahead = fmax(fmin(orbit->ahead, fast), -fast);
    orbit->doubt = fmin(orbit->doubt, fast);
    orbit->unrest = fmin(orbit->unrest, fast);
}

/* The share of an error of V that is left after `duration` [s], by the slope of the acceleration at the end. */
static double left_by_slope(OrbitRide *ride, double velocity, double duration) {
    double step = SLOPE_STEP * ride->law->fast.velocity;
    double slope = ride_acceleration(&ride, duration, velocity + step) -
                   ride_acceleration(&ride, duration, velocity - step);
    return exp(fmin(0.5 * slope / step, 0.0) * duration);
}

/* The same where inputs are held: that of the acceleration. */
static double left_by_excess(OrbitRide *ride, const ErrorPlace *from, const ErrorPlace *to,
                             double duration, const OrbitState *orbit) {
    const Law *law = ride->law;
    double full = friction_share(law) * law->device.drive_frequency * law->fast.velocity;
    if (fabs(from->acceleration) > SETTLED * full) {
        return fabs(to->acceleration / from->acceleration);
    }
    bool negligible = fabs(orbit->ahead) + orbit->doubt < NEGLIGIBLE_ERROR * resolution_error(law);
    return negligible ? 1.0 : left_by_slope(ride, to->velocity, duration);
}

/* Chi at which friction next to grazing is looked up, and the error of a sum over periods of the root of what
 * velocity lacks there, in the root of that of one: 0.21 at the worst phase, 0.07 at most of them. */
#define NEXT_TO_GRAZING 0.05
#define ROOT_SUM 0.1

/* Error [m/s] of passing grazing, beyond which the orbit is `beyond`: next to it friction grows by the root of
 * the distance, within a period. */
static double grazing_error(const OrbitRide *ride, const ErrorPlace *beyond) {
    const OrbitCurve *curve = ride->curve;
    double sign = beyond->velocity > curve->middle ? 1.0 : -1.0, inside, outside, factor;
    double reach = curve->reach * (1.0 - 0.5 * NEXT_TO_GRAZING * NEXT_TO_GRAZING);
    OrbitTables *tables = ride->law->orbits;
    if (!orbit_friction_at(tables, ride->curve, curve->middle + sign * reach, &inside, &factor) ||
        !orbit_friction_at(tables, ride->curve, beyond->velocity, &outside, &factor)) {
        return 0.0;
    }
    double period = ride->map->period, mass = ride->law->held.plant.total_mass;
    double chi = sqrt(2.0 * fabs(beyond->acceleration) * period / curve->reach);
    return ROOT_SUM * period / mass * fabs(outside - inside) / NEXT_TO_GRAZING * chi;
}

/* Slow acceleration [m/s^2] on an orbit under a load [N]. */
static double acceleration_on(const Law *law, const OrbitPoint *point, double load) {
    double force = point->of[ORBIT_FRICTION] + load;
    return -point->of[ORBIT_FACTOR] * force / law->held.plant.total_mass;
}

/* The error [m/s] where nothing is measured. */
static double unmeasured_error(const Law *law, const OrbitPoint *point, double load) {
    double force = point->of[ORBIT_FRICTION] + load;
    return point->found ? second_order_error(law, point->of[ORBIT_FACTOR] - 1.0, force)
                        : first_order_error(law);
}

void error_leave(const Law *law, OrbitState *orbit) {
    double swing = swing_by_inertia(law) * (1.0 + 1.0 / decay_in_turn(law));
    orbit->unrest += velocity_of_swing(law, swing * fabs(orbit->acceleration));
    bound(law, orbit);
}

void error_calm(const Law *law, double angle, OrbitState *orbit) {
    orbit->unrest *= exp(-fmin(decay_in_turn(law), SEEN) * angle / TAU);
}

void error_begin(OrbitRide *ride, const OrbitPoint *point, double velocity, double theta,
                 const Moment *now, OrbitState *orbit) {
    ErrorPlace place = error_place(ride, velocity, theta);
    orbit->unrest = error_of_swing(ride, velocity, theta, now);
    orbit->doubt += place.unsure * fabs(place.acceleration);
    if (!place.measured) {
        double added_mass = point->of[ORBIT_FACTOR] - 1.0;
        orbit->doubt = fmax(orbit->doubt, second_order_error(ride->law, added_mass, INFINITY));
    }
    orbit->acceleration = acceleration_on(ride->law, point, ride->law->inputs.load);
    bound(ride->law, orbit);
}

void error_carry(OrbitRide *ride, const ErrorPlace *from, const ErrorPlace *to,
                 const OrbitPoint *point, double duration, OrbitState *orbit) {
    const Law *law = ride->law;
    double gained, unsure;
    double angle = duration * law->device.drive_frequency;
    if (!from->measured || !to->measured ||
        !orbit_shift_gained(law->orbits, ride->curve, from->velocity, to->velocity, &gained,
                            &unsure)) {
        double load = law->inputs.load + law->held.plant.load_rate * duration;
        double before = orbit->acceleration;
        orbit->acceleration = acceleration_on(law, point, load);
        bool slower = fabs(orbit->acceleration) < fabs(before), searches = ride->source == FROM_SEARCH;
        double left = slower ? fabs(orbit->acceleration / before) : 1.0;
        left = searches ? left : left_by_slope(ride, to->velocity, duration);
        orbit->doubt = fmax(left * (orbit->doubt + fabs(orbit->ahead)),
                            unmeasured_error(law, point, load));
        orbit->ahead = 0.0;
        error_calm(law, angle, orbit);
        bound(law, orbit);
        return;
    }
    double a = to->acceleration, left = left_by_excess(ride, from, to, duration, orbit);
    double jump = fabs(from->acceleration - orbit->acceleration);
    orbit->unrest += velocity_of_swing(law, from->swing * jump);
    error_calm(law, angle, orbit);
    orbit->acceleration = a;
    gained -= 0.5 * (from->left_out + to->left_out) * duration;
    double error = left * (orbit->ahead + from->lag * from->acceleration) + gained * a;
    orbit->ahead = error - to->lag * a;
    orbit->doubt = left * (orbit->doubt + from->unsure * jump) + unsure * fabs(a);
    if (from->beyond != to->beyond) {
        const ErrorPlace *there = from->beyond ? from : to;
        bool slower = fabs(a) < fabs(there->acceleration);
        orbit->doubt += grazing_error(ride, there) * (slower ? fabs(a / there->acceleration) : 1.0);
    }
    bound(law, orbit);
}

double error_at(OrbitRide *ride, const ErrorPlace *place, const OrbitState *orbit) {
    const Law *law = ride->law;
    if (!place->measured) {
        OrbitPoint point = ride_point(ride, 0.0, place->velocity);
        return fmax(orbit->doubt, unmeasured_error(law, &point, law->inputs.load));
    }
    double jumped = velocity_of_swing(
        law, place->swing * fabs(place->acceleration - orbit->acceleration));
    double a = place->acceleration;
    return fabs(orbit->ahead + place->lag * a) + (place->of_turn + place->unsure) * fabs(a) +
           orbit->doubt + orbit->unrest + jumped + resolution_error(law);
}
