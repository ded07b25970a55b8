/* LuGre friction (eq. 8): from one reversal to the next along the bristle's path.
 *
 * Soon after a reversal the bristle is fully bent and friction is Coulomb's: closed forms take
 * over. Until then Taylor series follow the path, whose length shrinks with the bristle stiffness,
 * so the cost does not grow with it. There is no sticking; presliding is resolved as what it is, an
 * oscillation on the bristles. */
#include <math.h>

#include "friction_law.h"
#include "refusal_texts.h"
#include "velocity_scale.h"

/* Share of the tolerance that one series may use up, and that the bend of the bristle may still be
 * away from full when closed forms take over. */
#define TOLERANCE_SHARE 0.01

/* Without friction (8) has no meaning. */
static bool check(const Device *device, Refusal *refusal) {
    return device->friction_coefficient != 0.0 ||
           refuse_lugre_without_friction(refusal, device->friction_coefficient);
}

static double first_bristle(const Law *law) {
    return law->bristle.stiffness * law->device.initial_bristle_deflection;
}

static int mode(const Law *law, const Moment *moment) {
    const Held *held = &law->held;
    return mode_by_velocity(&held->window, &held->plant, moment->state.velocity, moment->psi);
}

static double force(const Law *law, const Moment *moment, int mode) {
    if (mode == LIFTED) {
        return 0.0;
    }
    const Bristle *bristle = &law->bristle;
    double velocity = moment->state.velocity, bent = moment->bristle;
    double drag = velocity - fabs(velocity) * bent / bristle->coefficient;
    double share = (bent + bristle->damping * drag) / bristle->coefficient;
    return friction_limit(&law->held.plant, moment->psi) * share;
}

static void begin(Leg *leg, const Law *law, const Moment *now, int direction) {
    const Held *held = &law->held;
    const Bristle *bristle = &law->bristle;
    double tolerance = TOLERANCE_SHARE * law->device.tolerance;
    double unbent = bristle->coefficient - direction * now->bristle;
    if (now->mode == LIFTED || fabs(unbent) <= tolerance * bristle->coefficient) {
        leg_begin_slide(leg, held, now, direction);
    } else {
        double scale = velocity_scale(&held->plant, &now->state);
        leg_begin_bending(leg, held, bristle, now, direction, tolerance * scale);
    }
}

/* In the direction that the slider has, or at rest takes. */
static void follow(Leg *leg, const Law *law, Moment *now, double longest, double switching) {
    (void)switching;
    begin(leg, law, now, now->state.velocity < 0.0 ? BACKWARD : FORWARD);
    if (now->state.velocity == 0.0 && !leg_departs(leg)) {
        begin(leg, law, now, BACKWARD);
    }
    leg_follow(leg, &law->held, now, longest);
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
    .check = check,
    .first_bristle = first_bristle,
    .mode = mode,
    .force = force,
    .follow = follow,
    .succeed = succeed,
    .averaged = &AVERAGED_LUGRE,
};
