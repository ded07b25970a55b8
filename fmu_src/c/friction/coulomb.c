/* Coulomb friction: closed-form motion from one event to the next.
 *
 * Events are a stop of the slider (then it sticks if friction can hold it, and reverses otherwise), a release, and the
 * lift-off and touchdown of the contact. There is no step size, no tolerance. */
#include "segment.h"

/* Relative difference of the forces on a slider up to which they count as balanced. */
#define BALANCED 1e-12

static bool prepare(const Device *device, Bristle *bristle, Refusal *refusal) {
    (void)refusal;
    *bristle = (Bristle){device->friction_coefficient, INFINITY, 0.0};
    return true;
}

/* The contact mode at rest: friction holds the slider up to its limit. Rounding releases nothing as the contact touches
 * down: each release would end at once, at the same time. */
static int mode_at_rest(const Plant *plant, const Moment *moment, const Phasors *phasors) {
    double rounding = EPSILON * (plant->friction_preload + plant->friction_amplitude);
    double needed = force_by(plant, &moment->state, phasors), limit = friction_limit_by(plant, phasors) + rounding;
    if (needed > limit) {
        return FORWARD;
    }
    return needed < -limit ? BACKWARD : STICK;
}

/* Whether a slider at rest was released at this moment: friction still balances the other forces, and only the mode of
 * the moment shows in which direction the slider departs. */
static bool just_released(const Plant *plant, const Moment *moment, const Phasors *phasors) {
    double limit = friction_limit_by(plant, phasors);
    double excess = moment->mode * force_by(plant, &moment->state, phasors) - limit;
    bool departs = moment->mode == FORWARD || moment->mode == BACKWARD;
    return departs && fabs(excess) <= BALANCED * (limit + plant->friction_preload + fabs(plant->load));
}

static int mode(const System *system, const Moment *moment) {
    const Plant *plant = &system->plant;
    int moving = mode_by_velocity(system, moment);
    if (moving != STICK) {
        return moving;
    }
    Phasors phasors = phasors_of(plant, moment);
    return just_released(plant, moment, &phasors) ? moment->mode : mode_at_rest(plant, moment, &phasors);
}

static double force(const System *system, const Moment *moment, int mode) {
    if (mode == LIFTED) {
        return 0.0;
    }
    Phasors phasors = phasors_of(&system->plant, moment);
    return mode == STICK ? force_by(&system->plant, &moment->state, &phasors)
                         : mode * friction_limit_by(&system->plant, &phasors);
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
        Phasors phasors = segment->phasors.known ? segment->phasors.phasors : phasors_of(plant, now);
        int moving = direction_of(now->state.velocity);
        mode = moving != STICK ? moving : mode_at_rest(plant, now, &phasors);
    } else if (switches) {
        mode = LIFTED;
    }
    moment_enter(now, mode);
}

const FrictionLaw COULOMB = {prepare, mode, force, begin, enter_next_mode};
