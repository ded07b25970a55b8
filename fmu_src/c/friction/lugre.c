/* LuGre friction (eq. 8): from one reversal to the next along the bristle's path.
 *
 * Soon after a reversal the bristle is fully bent and friction is Coulomb's: closed forms take over. Until then a panel
 * (bending_panel.h) or Taylor series (taylor_slide.h) follow the path. Its length falls with the bristle stiffness, so
 * the cost does not grow with that. There is no sticking: presliding is resolved as an oscillation on the bristles. */
#include "../base/refusal_texts.h"
#include "segment.h"

/* Share of the tolerance for the error of one segment, and for the bend that a bristle still lacks when closed forms
 * take over. */
#define TOLERANCE_SHARE 0.01

/* (8) divides by mu. */
static bool prepare(const Device *device, Bristle *bristle, Refusal *refusal) {
    *bristle = (Bristle){device->friction_coefficient, device->bristle_stiffness, device->bristle_damping};
    return device->friction_coefficient != 0.0 || refuse_lugre_without_friction(refusal, device->friction_coefficient);
}

static double force(const System *system, const Moment *moment, int mode) {
    if (mode == LIFTED) {
        return 0.0;
    }
    const Bristle *bristle = &system->bristle;
    double velocity = moment->state.velocity, bent = moment->bristle;
    double drag = velocity - fabs(velocity) * bent / bristle->coefficient;
    double share = (bent + bristle->damping * drag) / bristle->coefficient;
    Phasors phasors = phasors_of(&system->plant, moment);
    return friction_limit_by(&system->plant, &phasors) * share;
}

static void begin_in(int direction, Segment *segment, const System *system, const Moment *now, double longest) {
    const Bristle *bristle = &system->bristle;
    double tolerance = TOLERANCE_SHARE * system->device.tolerance;
    double unbent = bristle->coefficient - direction * now->bristle;
    if (now->mode == LIFTED || fabs(unbent) <= tolerance * bristle->coefficient) {
        segment_begin_slide(segment, system, now, direction);
    } else {
        segment_begin_bending(segment, system, now, direction, longest, tolerance);
    }
}

/* At rest the likely direction is that of a reversal. */
static void begin(Segment *segment, const System *system, const Moment *now, double longest) {
    int moving = direction_of(now->state.velocity), reversed = now->sliding > 0 ? BACKWARD : FORWARD;
    begin_in(moving != STICK ? moving : reversed, segment, system, now, longest);
    if (moving == STICK && !segment_departs(segment)) {
        begin_in(-reversed, segment, system, now, longest);
    }
}

static void enter_next_mode(const Segment *segment, const System *system, Moment *now, bool switches) {
    bool lifted = (segment->mode == LIFTED) != switches;
    now->bristle = bristle_after(&system->bristle, now->bristle, segment->travelled);
    now->mode = lifted ? LIFTED : direction_of(now->state.velocity);
    if (switches) {
        now->event_age = 0.0;
    }
}

const FrictionLaw LUGRE = {prepare, mode_by_velocity, force, begin, enter_next_mode};
