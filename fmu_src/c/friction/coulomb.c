/* Coulomb friction: closed-form motion from one event to the next.
 *
 * Events are a stop of the slider (then it sticks if friction can hold it, and reverses otherwise), a release, and the
 * lift-off and touchdown of the contact. There is no step size, no tolerance. */
#include "../base/elementary.h"
#include "segment.h"

/* Relative difference of the forces on a slider up to which they count as balanced. */
#define BALANCED 1e-12

static bool prepare(const Device *device, Bristle *bristle, Refusal *refusal) {
    (void)refusal;
    *bristle = (Bristle){device->friction_coefficient, INFINITY, 0.0};
    return true;
}

/* Friction force [N] that holds a slider at rest. */
static double needed_force(const Plant *plant, const Moment *moment) {
    const State *state = &moment->state;
    double resonator = plant->spring * state->displacement + plant->damper * state->rate;
    Complex direct = plant->holding_drive;
    if (direct.re == 0.0 && direct.im == 0.0) {
        return resonator - plant->load;
    }
    return resonator - plant->load + direct.re * sin(moment->theta) + direct.im * cos(moment->theta);
}

/* The contact mode at rest where friction is up to `limit` [N]. */
static int mode_at_rest(double limit, const Plant *plant, const Moment *moment) {
    double needed = needed_force(plant, moment);
    if (needed > limit) {
        return FORWARD;
    }
    return needed < -limit ? BACKWARD : STICK;
}

static int mode_in_contact(const Plant *plant, const Moment *moment) {
    if (moment->state.velocity != 0.0) {
        return direction_of(moment->state.velocity);
    }
    return mode_at_rest(friction_limit(plant, moment->psi), plant, moment);
}

/* Whether the slider was released at this moment: friction still balances the other forces, and only the mode of the
 * moment shows in which direction the slider departs. */
static bool just_released(const Plant *plant, const Moment *moment) {
    if (moment->state.velocity != 0.0 || !(moment->mode == FORWARD || moment->mode == BACKWARD)) {
        return false;
    }
    double limit = friction_limit(plant, moment->psi);
    double excess = moment->mode * needed_force(plant, moment) - limit;
    return fabs(excess) <= BALANCED * (limit + plant->friction_preload + fabs(plant->load));
}

static int mode(const System *system, const Moment *moment) {
    const Plant *plant = &system->plant;
    if (is_lifted(plant, moment->psi + plant->phase, plant->normal_frequency)) {
        return LIFTED;
    }
    return just_released(plant, moment) ? moment->mode : mode_in_contact(plant, moment);
}

static double force(const System *system, const Moment *moment, int mode) {
    if (mode == LIFTED) {
        return 0.0;
    }
    if (mode == STICK) {
        return needed_force(&system->plant, moment);
    }
    return mode * friction_limit(&system->plant, moment->psi);
}

/* A time [s] up to which a slider released in direction `sign` is guaranteed to move on; 0 if there is no guarantee.
 *
 * It starts with neither velocity nor acceleration, so that the velocity grows with the second power of time, v >= jerk
 * t^2 / 2 - B t^3 / 6 while B bounds its third derivative, and is positive up to t = 3 jerk / B. The search for the
 * next zero can start there, past the zero that the motion starts from. */
static double departure_time(const Plant *plant, int sign, const Moment *now) {
    const State *state = &now->state;
    double w = plant->drive_frequency, q = plant->normal_frequency, chi = now->psi + plant->phase;
    double amplitude = sign * plant->friction_amplitude, load_rate = amplitude * q * cos(chi);
    double drive_sine = sin(now->theta), drive_cosine = cos(now->theta);
    Complex direct = complex_mul(complex_of(drive_sine, -drive_cosine), plant->holding_drive);
    double force_rate = -w * direct.im - load_rate - plant->load_rate;
    double horizon = 1.0 / fmax(fmax(w, fabs(q)), plant->slip.frequency);
    double highest = fabs(q) + fabs(plant->normal_rate) * horizon;
    double load_bound = fabs(amplitude) * highest * highest + fabs(amplitude) * fabs(plant->normal_rate);
    double force_bound = complex_abs(plant->holding_drive) * w * w + load_bound;
    if (plant->mass_fraction != 0.0) {
        double decay = plant->slip.decay, stiffness = plant->slip.stiffness;
        double frequency = plant->slip.frequency;
        double resisting = sign * plant->friction_preload + amplitude * sin(chi) + plant->load;
        double forcing = plant->relative_drive * drive_sine + resisting / plant->slider_mass;
        double forcing_rate =
            plant->relative_drive * w * drive_cosine + (load_rate + plant->load_rate) / plant->slider_mass;
        double forcing_bound = fabs(plant->relative_drive) * w * w + load_bound / plant->slider_mass;
        double second = forcing - 2.0 * decay * state->rate - stiffness * state->displacement;
        double third = forcing_rate - 2.0 * decay * second - stiffness * state->rate;
        double energy = hypot(third, frequency * second) + horizon * forcing_bound;
        force_rate += plant->spring * state->rate + plant->damper * second;
        force_bound += (plant->spring / frequency + plant->damper) * energy;
    }
    double jerk = sign * force_rate;
    if (!(jerk > 0.0)) {
        return 0.0;
    }
    return 3.0 * jerk >= force_bound * horizon ? horizon : 3.0 * jerk / force_bound;
}

static void begin(Segment *segment, const System *system, const Moment *now, double longest) {
    (void)longest;
    int direction = now->mode == LIFTED ? 0 : now->mode;
    segment_begin_slide(segment, system, now, direction);
    if (direction != 0 && segment->departs) {
        segment->watched_from = departure_time(&system->plant, direction, now);
    }
}

static void enter_next_mode(const Segment *segment, const System *system, Moment *now, bool switches) {
    const Plant *plant = &system->plant;
    int mode = segment->mode;
    if (segment_released(segment)) {
        mode = segment->zero_of == 0 ? FORWARD : BACKWARD;
    } else if (segment_stopped(segment) || (switches && mode == LIFTED)) {
        mode = segment->known.known && now->state.velocity == 0.0
                   ? mode_at_rest(friction_limit_by(plant, &segment->known.phasors), plant, now)
                   : mode_in_contact(plant, now);
    } else if (switches) {
        mode = LIFTED;
    }
    moment_enter(now, mode);
}

const FrictionLaw COULOMB = {
    .prepare = prepare,
    .mode = mode,
    .force = force,
    .begin = begin,
    .enter_next_mode = enter_next_mode,
};
