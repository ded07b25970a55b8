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

/* What counts at one moment of a ride: slow velocity [m/s] and acceleration [m/s^2]; the time [s] by which V
 * is ahead of the motion whose W it has; the added mass, over the mass, that the table leaves out; and
 * how far the resonator lags [m], over the acceleration.
 * `measured` is false where there are no shifts, `beyond` true where the slider never turns back. */
typedef struct {
    bool measured, beyond;
    double velocity, acceleration, lag, of_turn, left_out, swing, unsure;
} ErrorPlace;

static bool has_shifts(const OrbitRide *ride) {
    bool curve = ride->source == FROM_CURVE || ride->source == FROM_COMBINED;
    return curve && !is_ramped(&ride->law->held.plant) && !slow_phase_drifts(&ride->slow);
}

/* The place at a velocity [m/s] and drive phase `theta` [rad] over all turns of the orbit, under the inputs with
 * which the ride begins. */
static ErrorPlace place_at(OrbitRide *ride, double velocity, double theta) {
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
static double error_of_swing(const OrbitRide *ride, const OpenError *open) {
    const PeriodMap *map = ride->map;
    const Law *law = ride->law;
    HeldOrbit orbit;
    Moment there;
    if (held_orbit_at(map, ride->lead, open->velocity, NULL, &orbit) != ORBIT_FOUND ||
        held_orbit_linearise(map, &orbit) != ORBIT_FOUND ||
        !held_orbit_moment(map, &orbit, law->inputs.load, open->angle, &there)) {
        return 0.0;
    }
    double displacement = open->displacement - there.state.displacement;
    double rate = (open->rate - there.state.rate) / law->device.drive_frequency;
    return velocity_of_free_swing(law, hypot(displacement, rate));
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

/* The error [m/s] where nothing is measured, friction adds a mass, and friction and load leave a force [N]. */
static double error_by_rule(const OrbitRide *ride, double added_mass, double force) {
    double drift = ride->slow.turns * ride->slow.fastest;
    return second_order_error(ride->law, added_mass, force) + drift_error(ride->law, drift);
}

/* The error [m/s] where nothing is measured. */
static double unmeasured_error(const OrbitRide *ride, const OrbitPoint *point, double load) {
    double added_mass = point->of[ORBIT_FACTOR] - 1.0;
    return point->found ? error_by_rule(ride, added_mass, point->of[ORBIT_FRICTION] + load)
                        : first_order_error(ride->law);
}

bool is_without_error(const OrbitState *orbit) {
    return orbit->open.kind == TAKEN_OVER && orbit->open.elapsed == 0.0;
}

void error_leave(const Law *law, OrbitState *orbit) {
    double swing = swing_by_inertia(law) * (1.0 + 1.0 / decay_in_turn(law));
    orbit->unrest += velocity_of_swing(law, swing * fabs(orbit->acceleration));
    orbit->doubt = fmax(orbit->doubt, resolution_error(law));
    bound(law, orbit);
}

void error_calm(const Law *law, double angle, OrbitState *orbit) {
    orbit->unrest *= exp(-fmin(decay_in_turn(law), SEEN) * angle / TAU);
}

/* Take in the end of resolved motion. */
static void begin_at(OrbitRide *ride, const ErrorPlace *place, const OpenError *open,
                     OrbitState *orbit) {
    orbit->unrest = error_of_swing(ride, open);
    orbit->doubt += place->unsure * fabs(place->acceleration);
    if (!place->measured) {
        OrbitPoint point = ride_point(ride, 0.0, open->velocity);
        /* An orbit that cannot be probed may differ by all that friction does. */
        double load = has_shifts(ride) ? INFINITY : ride->law->inputs.load;
        orbit->doubt = fmax(orbit->doubt, unmeasured_error(ride, &point, load));
    }
    bound(ride->law, orbit);
}

/* Carry the error on over `duration` [s] to an orbit where shifts are not measured. */
static void carry_unmeasured(OrbitRide *ride, const ErrorPlace *from, const ErrorPlace *to,
                             const OrbitPoint *point, double duration, OrbitState *orbit) {
    const Law *law = ride->law;
    double load = law->inputs.load + law->held.plant.load_rate * duration;
    double before = orbit->acceleration, left;
    orbit->acceleration = acceleration_on(law, point, load);
    if (has_shifts(ride)) {
        left = left_by_excess(ride, from, to, duration, orbit);
    } else if (ride->source == FROM_SEARCH) {
        bool slower = fabs(orbit->acceleration) < fabs(before);
        left = slower ? fabs(orbit->acceleration / before) : 1.0;
    } else {
        left = left_by_slope(ride, to->velocity, duration);
    }
    orbit->doubt =
        fmax(left * (orbit->doubt + fabs(orbit->ahead)), unmeasured_error(ride, point, load));
    orbit->ahead = 0.0;
    error_calm(law, duration * law->device.drive_frequency, orbit);
    bound(law, orbit);
}

/* Carry the error on over `duration` [s] to another place, whose orbit is `point`. */
static void carry(OrbitRide *ride, const ErrorPlace *from, const ErrorPlace *to,
                  const OrbitPoint *point, double duration, OrbitState *orbit) {
    const Law *law = ride->law;
    double gained, unsure;
    if (!from->measured || !to->measured ||
        !orbit_shift_gained(law->orbits, ride->curve, from->velocity, to->velocity, &gained,
                            &unsure)) {
        carry_unmeasured(ride, from, to, point, duration, orbit);
        return;
    }
    double a = to->acceleration, left = left_by_excess(ride, from, to, duration, orbit);
    double jump = fabs(from->acceleration - orbit->acceleration);
    orbit->unrest += velocity_of_swing(law, from->swing * jump);
    error_calm(law, duration * law->device.drive_frequency, orbit);
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

/* Take in what is open, up to the orbit `point`. */
static void settle_on(OrbitRide *ride, const OrbitPoint *point, double theta, OrbitState *orbit) {
    const OpenError open = orbit->open;
    orbit->open = (OpenError){.kind = NOTHING_OPEN};
    ErrorPlace from = place_at(ride, open.velocity, open.angle);
    if (open.kind == TAKEN_OVER) {
        begin_at(ride, &from, &open, orbit);
    }
    if (open.elapsed > 0.0) {
        ErrorPlace to = place_at(ride, orbit->velocity, theta);
        carry(ride, &from, &to, point, open.elapsed, orbit);
    }
}

void error_begin(OrbitRide *ride, const OrbitPoint *point, double velocity, double theta,
                 const Moment *now, OrbitState *orbit) {
    orbit->acceleration = acceleration_on(ride->law, point, ride->law->inputs.load);
    orbit->open =
        (OpenError){TAKEN_OVER, 0.0, velocity, theta, now->state.displacement, now->state.rate};
}

void error_jump(const Law *law, OrbitState *orbit) {
    double rate = orbit->swing.rate / law->device.drive_frequency;
    orbit->doubt += velocity_by_friction(law, hypot(orbit->swing.displacement, rate));
    bound(law, orbit);
}

void error_open(double theta, OrbitState *orbit) {
    if (orbit->open.kind == NOTHING_OPEN) {
        orbit->open = (OpenError){.kind = FOLLOWED, .velocity = orbit->velocity, .angle = theta};
    }
}

void error_follow(OrbitRide *ride, const OrbitPoint *point, double theta, double duration,
                  OrbitState *orbit) {
    orbit->open.elapsed += duration;
    if (!has_shifts(ride)) {
        settle_on(ride, point, theta, orbit);
    }
}

void error_settle(OrbitRide *ride, double theta, OrbitState *orbit) {
    if (orbit->open.kind != NOTHING_OPEN) {
        OrbitPoint point = ride_point(ride, 0.0, orbit->velocity);
        settle_on(ride, &point, theta, orbit);
    }
}

double error_at(OrbitRide *ride, double theta, const OrbitState *now) {
    const Law *law = ride->law;
    OrbitState settled = *now, *orbit = &settled;
    error_settle(ride, theta, orbit);
    ErrorPlace place = place_at(ride, orbit->velocity, theta);
    if (!place.measured) {
        OrbitPoint point = ride_point(ride, 0.0, place.velocity);
        return fmax(orbit->doubt, unmeasured_error(ride, &point, law->inputs.load));
    }
    double a = place.acceleration;
    double jumped = velocity_of_swing(law, place.swing * fabs(a - orbit->acceleration));
    return fabs(orbit->ahead + place.lag * a) + (place.of_turn + place.unsure) * fabs(a) +
           orbit->doubt + orbit->unrest + jumped + resolution_error(law);
}
