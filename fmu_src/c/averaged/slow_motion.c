/* Averaged motion of first order, fidelity 0: the slow motion of the pair under mean friction.
 *
 * With D the amplitude of the drive force on the pair, its momentum over the total mass is P = X' + r_m Y' = V - D
 * cos(theta) / (w (M + m)), and its centre is X + r_m Y. Both are continuous, also where a parameter is tuned. V is the
 * slow velocity: (M + m) V' = -mean friction - load. The fast parts of all outputs are the steady vibration (32)-(33),
 * added in closed form.
 *
 * The bristle follows the motion periodically; it has no state here. */
#include "../base/elementary.h"
#include "../resolved/motion.h"
#include "slow_equation.h"

/* Error of first order in friction shares and v_q: that of the average, and that of what the average leaves out, the
 * resonator's first swing and the first bend of bristles. */
#define FIRST_ORDER 2.0

/* The initial values determine the momentum of the pair, not its vibration: the first step takes care of that. */
static Moment start(const System *system) {
    Moment first = first_moment(&system->device);
    first.mode = mode_by_velocity(system, &first);
    first.means.complete = 1.0;
    first.means.mean_velocity = slow_velocity(system, &first.state, first.theta);
    return first;
}

/* In this order: take the slow velocity and the centre of the pair from the state; pass the slow motion; turn the
 * phases; add the steady vibration again. */
static bool averaged_advance(const System *system, const Moment *moment, double duration, EventSearch *search,
                             Budget *budget, Moment *after, Refusal *refusal) {
    (void)search;
    const Plant *plant = &system->plant;
    double w = plant->drive_frequency, drive = system->fast.pair_velocity;
    double share = device_mass_fraction(&system->device);
    double theta = moment->theta, psi = moment->psi;
    State state = moment->state;
    SlowPoint reached = {.velocity = slow_velocity(system, &state, theta)};
    double centre = moment->position + share * state.displacement + drive / w * sin(theta);
    SlowFriction friction = slow_friction_of(system, theta, psi);
    if (!slow_pass(&friction, duration, budget, &reached, refusal)) {
        return false;
    }
    theta = within_turn(theta + w * duration);
    psi = within_turn(psi + turned_by(plant, duration));
    Response swing = steady_swing(system->fast.resonator, theta, w);
    state.velocity = reached.velocity - drive * cos(theta) - share * swing.rate;
    state.displacement = swing.displacement;
    state.rate = swing.rate;
    Moment next = {.state = state, .theta = theta, .psi = psi, .event_age = INFINITY, .sliding = moment->sliding};
    next.reversals = moment->reversals;
    next.position = centre + reached.travel - drive / w * sin(theta) - share * swing.displacement;
    next.mode = mode_by_velocity(system, &next);
    next.means.complete = 1.0;
    next.means.mean_velocity = reached.velocity;
    *after = next;
    return true;
}

/* Mean friction force [N] over a drive period, positive against +X. */
static double force(const System *system, const Moment *moment, int contact_mode) {
    (void)contact_mode;
    double velocity = slow_velocity(system, &moment->state, moment->theta);
    SlowFriction friction = slow_friction_of(system, moment->theta, moment->psi);
    if (system->fast.velocity == 0.0 && velocity == 0.0) {
        double full = slow_friction_at(&friction, 0.0, INFINITY);
        return fmax(-full, fmin(full, -system->inputs.load));
    }
    return slow_friction_at(&friction, 0.0, velocity);
}

/* Mean power of friction [W] over a drive period, of slow motion and vibration. */
static double power(const System *system, const Moment *moment) {
    double velocity = slow_velocity(system, &moment->state, moment->theta);
    if (system->fast.velocity == 0.0) {
        return force(system, moment, STICK) * velocity;
    }
    SlowFriction friction = slow_friction_of(system, moment->theta, moment->psi);
    return slow_friction_power(&friction, velocity);
}

/* The slow acceleration and the steady vibration. */
static Rates rates(const System *system, const Moment *moment) {
    double w = system->plant.drive_frequency, share = device_mass_fraction(&system->device);
    double slow = -(force(system, moment, STICK) + system->inputs.load) / system->plant.total_mass;
    Response swing = steady_swing(system->fast.resonator, moment->theta, w);
    State state = {.displacement = swing.rate, .rate = -w * w * swing.displacement};
    state.velocity = slow + system->fast.pair_velocity * w * sin(moment->theta) - share * state.rate;
    return (Rates){state, slow};
}

/* Velocity [m/s] that mean friction changes in a radian of the drive, faces mu N0 / (Mt w), what bristles damp
 * included: over v_q it is the small number by which averages expand. */
static double friction_in_radian(const System *system) {
    double w = system->device.drive_frequency;
    double damping = damping_share(&system->bristle, system->fast.velocity, w);
    return full_friction(&system->device) * hypot(1.0, damping) / (system->plant.total_mass * w);
}

/* Decay in a turn of the drive, as an exponent, of the resonator's own vibration or of a bend of the bristle, the
 * slower one; infinite without both. The path of a turn is four times the amplitude. */
static double decay_in_turn(const System *system) {
    const Device *device = &system->device;
    double w = device->drive_frequency, path = 4.0 * system->fast.velocity / w;
    const Bristle *bristle = &system->bristle;
    double bend_decay = is_elastic(bristle) ? bristle->stiffness * path / bristle->coefficient : INFINITY;
    if (device->resonator_mass == 0.0) {
        return bend_decay;
    }
    return fmin(slower_decay(&system->plant.slip) * TAU / w, bend_decay);
}

/* In proportion to the velocity that friction changes in a radian. Where nothing vibrates, friction is constant and
 * averages are exact. */
static double error(const System *system, const Moment *moment) {
    (void)moment;
    double fast = system->fast.velocity, changed = friction_in_radian(system);
    bool vibrates = fast > 0.0 || (system->device.normal_amplitude > 0.0 && system->plant.normal_frequency != 0.0);
    if (!vibrates || !(changed > 0.0)) {
        return 0.0;
    }
    double decay = decay_in_turn(system), swing = 1.0 + 1.0 / fmax(decay, SMALLEST);
    return fmin(FIRST_ORDER * changed * swing, fmax(fast, changed));
}

/* The time in which the normal load has one slow phase. */
static double part(const Device *device, const Ramp *ramp, double left) {
    if (ramp->ratio_rate == 0.0 || device->normal_amplitude == 0.0) {
        return left;
    }
    double boundary = next_slow_boundary(device, ramp->ratio, copysign(1.0, ramp->ratio_rate));
    /* By rounding, a boundary that was reached may be just ahead. */
    double ahead = fmax(fabs(boundary - ramp->ratio), EXACT * fmax(1.0, fabs(ramp->ratio)));
    return fmin(left, ahead / fabs(ramp->ratio_rate));
}

const Motion AVERAGED_MOTION = {
    .start = start,
    .advance = averaged_advance,
    .mode = mode_by_velocity,
    .force = force,
    .power = power,
    .rates = rates,
    .error = error,
    .part = part,
};
