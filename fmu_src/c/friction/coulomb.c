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

static void begin(Segment *segment, const System *system, const Moment *now, double longest) {
    (void)longest;
    segment_begin_slide(segment, system, now, now->mode == LIFTED ? 0 : now->mode);
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
