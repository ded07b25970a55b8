#include "slow_motion.h"

#include "../base/angle.h"
#include "../base/constants.h"
#include "../base/elementary.h"
#include "slow_friction.h"
#include "slow_motion_error.h"
#include "slow_pass.h"

/* Error per step of the slow motion, relative to the fast velocity. */
#define TOLERANCE 2e-10

/* Number of waves of the normal load over a turn that doubles the cost of a quadrature, and number beyond
 * which the load counts with its mean. */
#define WAVES 10.0
#define MAX_WAVES 1000.0

/* Lower limit of the number of steps that is accepted. */
enum { MIN_STEPS = 16 };

/* Pieces of a beat, with constant friction in each, in motion without vibration. */
#define PIECES 256.0

/* Largest number of legs of a block under a load that grows: it stops, sticks and sets out twice at most. */
enum { MAX_BLOCK_LEGS = 8 };

/* Largest cost of a step under a growing load, relative to one under a constant load. */
enum { GROWING = 4 };

/* Direction in which a block at rest sets out under a load that grows by `rate` [N/s]; STICK while friction
 * holds it. */
static int block_sets_out(double friction, double load, double rate) {
    if (fabs(load) > friction || (fabs(load) == friction && load * rate > 0.0)) {
        return load > 0.0 ? BACKWARD : FORWARD;
    }
    return STICK;
}

/* Motion of a block without vibration under constant friction [N] and a load that grows by `rate` [N/s]. */
static Reached block_after(double velocity, double friction, double load, double rate, double mass,
                           double duration) {
    Reached reached = {.t = duration, .velocity = velocity};
    double left = duration;
    for (int leg = 0; leg < MAX_BLOCK_LEGS && left > 0.0; leg++) {
        int direction = direction_of(reached.velocity);
        if (direction == STICK) {
            direction = block_sets_out(friction, load, rate);
        }
        double a = -(direction * friction + load) / mass, j = -rate / mass;
        double end = INFINITY;
        if (direction != STICK) {
            end = time_to_stop(direction * reached.velocity, direction * a, direction * j);
        } else if (rate != 0.0) {
            end = (copysign(friction, rate) - load) / rate;
        }
        double t = fmin(left, end);
        if (direction != STICK) {
            reached.moved += (reached.velocity + (0.5 * a + j * t / 6.0) * t) * t;
            reached.velocity = end <= left ? 0.0 : reached.velocity + (a + 0.5 * j * t) * t;
        }
        load = direction == STICK && end <= left ? copysign(friction, rate) : load + rate * t;
        left -= t;
    }
    return reached;
}

static double slow_acceleration(const void *motion, double t, double velocity) {
    const SlowFriction *friction = motion;
    const Plant *plant = &friction->law->held.plant;
    double load = plant->load + plant->load_rate * t;
    return -(slow_friction_at(friction, t, velocity) + load) / plant->total_mass;
}

static double time_to_kink(const void *motion, double t) {
    return slow_friction_to_kink(motion, t);
}

/* Motion without vibration, with constant friction in each piece of time. */
static bool pass_unshaken(const SlowFriction *friction, double duration, Budget *budget,
                          Reached *reached, Refusal *refusal) {
    const Plant *plant = &friction->law->held.plant;
    double longest = friction->stands ? fmin(duration, friction->beat / PIECES) : duration;
    double pieces = ceil(duration / longest), piece = duration / pieces;
    int allowed = budget_left(budget, MAX_SLOW_STEPS);
    if (pieces > allowed) {
        return budget_refuse(budget, allowed * longest, MAX_SLOW_STEPS, "steps of averaged motion",
                             refusal);
    }
    budget_spend(budget, (int)pieces, MAX_SLOW_STEPS);
    double moved = 0.0, rate = plant->load_rate, mass = plant->total_mass;
    for (double k = 0.0; k < pieces; k += 1.0) {
        double resisting = slow_friction_at(friction, (k + 0.5) * piece, INFINITY);
        double load = plant->load + rate * (k * piece);
        *reached = block_after(reached->velocity, resisting, load, rate, mass, piece);
        moved += reached->moved;
    }
    reached->moved = moved;
    return true;
}

/* Steps of averaged motion that a whole budget buys. */
static int max_steps(const SlowFriction *friction) {
    if (!slow_friction_is_expensive(friction)) {
        bool grows = friction->law->held.plant.load_rate != 0.0;
        return grows ? MAX_SLOW_STEPS / GROWING : MAX_SLOW_STEPS;
    }
    double waves = fmin(fabs(friction->law->inputs.frequency_ratio), MAX_WAVES);
    return (int)fmax(MIN_STEPS, MAX_QUADRATURE_STEPS / (1.0 + waves / WAVES));
}

/* Largest Coulomb friction [N] over all phases of the normal load. */
static double strongest_friction(const Device *device) {
    double normal = device->normal_preload + device->normal_amplitude;
    return device->friction_faces * device->friction_coefficient * normal;
}

/* Integrate the slow velocity over `duration` [s]. A velocity that settles takes few steps, however long
 * the duration is. */
static bool pass(const SlowFriction *friction, double duration, Budget *budget, Reached *reached,
                 Refusal *refusal) {
    const Plant *plant = &friction->law->held.plant;
    double fast = friction->law->fast.velocity;
    if (fast == 0.0) {
        return pass_unshaken(friction, duration, budget, reached, refusal);
    }
    double last_load = plant->load + plant->load_rate * duration;
    double strongest = strongest_friction(&friction->law->device) +
                       fmax(fabs(plant->load), fabs(last_load));
    SlowPass plan = {
        .acceleration = slow_acceleration,
        .to_kink = time_to_kink,
        .motion = friction,
        .fast = fast,
        .tolerance = TOLERANCE * fast,
        .step = slow_pass_step(fast, plant->total_mass, strongest, duration),
        .beat = friction->beat,
        .may_settle = !slow_phase_drifts(&friction->slow) && plant->load_rate == 0.0,
        .max_steps = max_steps(friction),
        .edge = {-fast, fast},
        .jerk = -plant->load_rate / plant->total_mass,
        .sway = slow_friction_sway(friction) / plant->total_mass,
    };
    Reached now = {.velocity = reached->velocity, .step = plan.step};
    if (!slow_pass(&plan, duration, budget, &now, refusal)) {
        return false;
    }
    *reached = now;
    return true;
}

double slow_velocity(const Law *law, const State *state, double theta) {
    double momentum = state->velocity + device_mass_fraction(&law->device) * state->rate;
    return momentum + law->fast.pair_velocity * cos(theta);
}

/* Contact mode: lifted, or the direction of sliding with the fast vibration; STICK only at rest. */
static int mode(const Law *law, const Moment *moment) {
    const Held *held = &law->held;
    return mode_by_velocity(&held->window, &held->plant, moment->state.velocity, moment->psi);
}

/* The initial values determine the momentum of the pair, not its vibration: the first step takes care of that. */
static Moment start(const Law *law) {
    const Device *device = &law->device;
    Moment first = {.position = device->initial_position, .event_age = INFINITY};
    first.state.velocity = device->initial_velocity;
    first.state.displacement = device->initial_resonator_displacement;
    first.state.rate = device->initial_resonator_velocity;
    first.mode = mode(law, &first);
    first.means.complete = true;
    first.means.mean_velocity = slow_velocity(law, &first.state, first.theta);
    return first;
}

/* In this order: take the slow velocity and the centre of the pair from the state; pass the slow motion; turn the phases;
 * add the steady vibration again. */
static bool advance(const Law *law, const Moment *moment, double duration, EventSearch *search,
                    Budget *budget, Moment *after, Refusal *refusal) {
    (void)search;
    const Plant *plant = &law->held.plant;
    double w = plant->drive_frequency, drive = law->fast.pair_velocity;
    double share = device_mass_fraction(&law->device);
    double theta = moment->theta, psi = moment->psi;
    State state = moment->state;
    Reached reached = {.velocity = slow_velocity(law, &state, theta)};
    double centre = moment->position + share * state.displacement + drive / w * sin(theta);
    SlowFriction friction = slow_friction_of(law, theta, psi);
    if (!pass(&friction, duration, budget, &reached, refusal)) {
        return false;
    }
    theta = within_turn(theta + w * duration);
    psi = within_turn(psi + turned_by(plant, duration));
    Response swing = steady_swing(law->fast.resonator, theta, w);
    state.velocity = reached.velocity - drive * cos(theta) - share * swing.rate;
    state.displacement = swing.displacement;
    state.rate = swing.rate;
    Moment next = {.state = state, .theta = theta, .psi = psi, .counts = moment->counts};
    next.position = centre + reached.moved - drive / w * sin(theta) - share * swing.displacement;
    next.mode = mode(law, &next);
    next.event_age = INFINITY;
    next.means.complete = true;
    next.means.mean_velocity = reached.velocity;
    *after = next;
    return true;
}

/* Mean friction force [N] over a drive period, positive against +X. */
static double force(const Law *law, const Moment *moment, int contact_mode) {
    (void)contact_mode;
    double velocity = period_mean_velocity(&moment->means, moment->state.velocity);
    SlowFriction friction = slow_friction_of(law, moment->theta, moment->psi);
    if (law->fast.velocity == 0.0 && velocity == 0.0) {
        double full = slow_friction_at(&friction, 0.0, INFINITY);
        return fmax(-full, fmin(full, -law->inputs.load));
    }
    return slow_friction_at(&friction, 0.0, velocity);
}

/* The slow acceleration and the steady vibration. */
static Rates rates(const Law *law, const Moment *moment) {
    double w = law->held.plant.drive_frequency, share = device_mass_fraction(&law->device);
    double slow = -(force(law, moment, STICK) + law->inputs.load) / law->held.plant.total_mass;
    Response swing = steady_swing(law->fast.resonator, moment->theta, w);
    State state = {.displacement = swing.rate, .rate = -w * w * swing.displacement};
    state.velocity =
        slow + law->fast.pair_velocity * w * sin(moment->theta) - share * state.rate;
    return (Rates){state, slow};
}

static double error(const Law *law, const Moment *moment) {
    (void)moment;
    return first_order_error(law);
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

static bool prepare(Law *law, Refusal *refusal) {
    return fast_vibration_prepare(&law->fast, &law->device, refusal);
}

const Motion AVERAGED_MOTION = {
    .averages = true,
    .prepare = prepare,
    .start = start,
    .advance = advance,
    .mode = mode,
    .force = force,
    .rates = rates,
    .error = error,
    .part = part,
};
