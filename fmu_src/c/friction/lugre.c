/* LuGre friction (eq. 8): from one reversal to the next along the bristle's path.
 *
 * Soon after a reversal the bristle is fully bent and friction is Coulomb's: closed forms take over. Until
 * then a panel (bending_panel.h) or Taylor series (taylor_slide.h) follow the path. Its length falls with
 * the bristle stiffness, so the cost does not grow with that. There is no sticking: presliding is resolved
 * as an oscillation on the bristles. */
#include "../base/refusal_texts.h"
#include "leg.h"

/* Share of the tolerance for the error of one leg, and for the bend that a bristle still lacks when closed
 * forms take over. */
#define TOLERANCE_SHARE 0.01

/* (8) divides by mu. */
static bool prepare(const Device *device, Bristle *bristle, Refusal *refusal) {
    *bristle = (Bristle){device->friction_coefficient, device->bristle_stiffness, device->bristle_damping};
    return device->friction_coefficient != 0.0 ||
           refuse_lugre_without_friction(refusal, device->friction_coefficient);
}

static double force(const Law *law, const Moment *moment, int mode) {
    if (mode == LIFTED) {
        return 0.0;
    }
    const Bristle *bristle = &law->bristle;
    double velocity = moment->state.velocity, bent = moment->bristle;
    double drag = velocity - fabs(velocity) * bent / bristle->coefficient;
    double share = (bent + bristle->damping * drag) / bristle->coefficient;
    return friction_limit(&law->plant, moment->psi) * share;
}

static void begin_in(int direction, Leg *leg, const Law *law, const Moment *now, double longest) {
    const Bristle *bristle = &law->bristle;
    double tolerance = TOLERANCE_SHARE * law->device.tolerance;
    double unbent = bristle->coefficient - direction * now->bristle;
    if (now->mode == LIFTED || fabs(unbent) <= tolerance * bristle->coefficient) {
        leg_begin_slide(leg, law, now, direction);
    } else {
        leg_begin_bending(leg, law, now, direction, longest, tolerance);
    }
}

/* The direction of the velocity or, at rest, of the force on the slider. */
static int likely_direction(Leg *leg, const Law *law, const Moment *now) {
    const Plant *plant = &law->plant;
    if (now->state.velocity != 0.0 || now->mode == LIFTED) {
        return now->state.velocity < 0.0 ? BACKWARD : FORWARD;
    }
    leg_know_phasors(leg, plant, now);
    double limit = friction_limit_by(plant, &leg->known.phasors);
    double resisting = limit * now->bristle / law->bristle.coefficient;
    return force_by(plant, &now->state, &leg->known.phasors) < resisting ? BACKWARD : FORWARD;
}

static void begin(Leg *leg, const Law *law, const Moment *now, double longest) {
    begin_in(likely_direction(leg, law, now), leg, law, now, longest);
    if (now->state.velocity == 0.0 && !leg_departs(leg)) {
        begin_in(-leg->direction, leg, law, now, longest);
    }
}

static void succeed(const Leg *leg, const Law *law, Moment *now, bool switches) {
    bool lifted = (leg->mode == LIFTED) != switches;
    now->bristle = bristle_after(&law->bristle, now->bristle, leg->travelled);
    now->mode = lifted ? LIFTED : direction_of(now->state.velocity);
    if (switches) {
        now->event_age = 0.0;
    }
}

const FrictionLaw LUGRE = {
    .prepare = prepare,
    .mode = mode_by_velocity,
    .force = force,
    .begin = begin,
    .succeed = succeed,
};
