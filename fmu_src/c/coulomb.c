#include "coulomb.h"

#include <math.h>

#include "angle.h"
#include "clock.h"
#include "departure.h"
#include "slide.h"
#include "stick.h"
#include "stops.h"

/* Share of the longest arc within which a release and a lift-off may be the same event. */
#define SAME 1e-6

/* Part of the longest arc below which a motion counts as no progress in time: more than the
 * shortest step of the search for zeros, which forces within rounding of zero may end again and
 * again. */
#define STALLED 1e-6

/* Motion within one contact mode, and how it ends: after `t` [s], at the zero of a watched signal
 * (`zero_of` >= 0) or not. */
typedef struct {
    int mode;
    union {
        Slide slide;
        Stick stick;
    } motion;
    double t;
    int zero_of;
} Leg;

double needed_force(const Plant *plant, const State *state, double theta) {
    double resonator = plant->spring * state->displacement + plant->damper * state->rate;
    Complex direct = plant->holding_drive;
    if (direct.re == 0.0 && direct.im == 0.0) {
        return resonator - plant->load;
    }
    return resonator - plant->load + direct.re * sin(theta) + direct.im * cos(theta);
}

double friction_limit(const Plant *plant, double psi) {
    double limit = plant->friction_preload + plant->friction_amplitude * sin(psi + plant->phase);
    return limit > 0.0 ? limit : 0.0;
}

static int mode_in_contact(const Plant *plant, const State *state, double theta, double psi) {
    if (state->velocity != 0.0) {
        return state->velocity > 0.0 ? FORWARD : BACKWARD;
    }
    double needed = needed_force(plant, state, theta), limit = friction_limit(plant, psi);
    if (needed > limit) {
        return FORWARD;
    }
    return needed < -limit ? BACKWARD : STICK;
}

int coulomb_mode_of(const Held *held, const State *state, double theta, double psi) {
    const Plant *plant = &held->plant;
    if (is_lifted(&held->window, psi + plant->phase, plant->normal_frequency)) {
        return LIFTED;
    }
    return mode_in_contact(plant, state, theta, psi);
}

double coulomb_friction_force(const Held *held, const Moment *moment, int mode) {
    if (mode == LIFTED) {
        return 0.0;
    }
    if (mode == STICK) {
        return needed_force(&held->plant, &moment->state, moment->theta);
    }
    return mode * friction_limit(&held->plant, moment->psi);
}

static bool is_sliding(int mode) {
    return mode == FORWARD || mode == BACKWARD;
}

Moment coulomb_start(const Held *held, State state, double position) {
    int mode = coulomb_mode_of(held, &state, 0.0, 0.0);
    Moment moment = {.state = state, .position = position, .mode = mode, .event_age = INFINITY};
    moment.counts.sliding = is_sliding(mode) ? mode : 0;
    return moment;
}

/* Whether a stick ends only because the contact lifts: all friction is gone by then. */
static bool lifts_first(const Plant *plant, double chi) {
    double limit = plant->friction_preload + plant->friction_amplitude * sin(chi);
    return limit <= 16.0 * EPSILON * (plant->friction_preload + plant->friction_amplitude);
}

/* What a run carries along: the moment, whether the slider is at rest there and about to move, and
 * where it is expected to stop. */
typedef struct {
    Moment now;
    bool leaving;
    Stops stops;
} Run;

static Stop *stop_of(Run *run, int mode) {
    return mode == FORWARD ? &run->stops.forward : &run->stops.backward;
}

/* Ends a stick at the release that comes first. One release is searched for over a turn at most, as
 * the other may come soon. */
static void stick_follow(Leg *leg, const Held *held, const Run *run, double longest,
                         double switch_time) {
    const Plant *plant = &held->plant;
    double chi = run->now.psi + plant->phase;
    Watch watches[2];
    stick_begin(&leg->motion.stick, plant, &run->now.state, run->now.theta, chi);
    int count = stick_watches(&leg->motion.stick, watches);
    leg->t = count > 0 ? fmin(longest, TAU / plant->drive_frequency) : longest;
    for (int i = 0; i < count; i++) {
        double zero = first_zero(&watches[i], leg->t, 0.0);
        if (zero >= 0.0) {
            leg->t = zero;
            leg->zero_of = i;
        }
    }
    bool near_switch = switch_time == longest && switch_time - leg->t < SAME * held->arc;
    if (leg->zero_of >= 0 && near_switch &&
        lifts_first(plant, chi + plant->normal_frequency * leg->t)) {
        leg->t = switch_time;
        leg->zero_of = -1;
    }
}

static void slide_follow(Leg *leg, const Held *held, Run *run, double longest) {
    const Plant *plant = &held->plant;
    const Moment *now = &run->now;
    int sign = leg->mode == LIFTED ? 0 : leg->mode;
    double chi = now->psi + plant->phase, begin = 0.0;
    slide_begin(&leg->motion.slide, held, sign, &now->state, now->theta, chi, sign);
    leg->t = longest;
    if (sign == 0) {
        return;
    }
    if (run->leaving) {
        begin = departure_time(plant, sign, &now->state, now->theta, chi);
    }
    Watch watch = slide_watch(&leg->motion.slide);
    double expected = stop_expected(stop_of(run, sign), now->theta, plant->drive_frequency);
    double zero = first_zero_near(&watch, longest, begin, expected);
    if (zero >= 0.0) {
        leg->t = zero;
        leg->zero_of = 0;
    }
}

/* The motion from now on for up to `longest` [s], until it ends; the contact switches after
 * `switch_time` [s]. */
static void leg_follow(Leg *leg, const Held *held, Run *run, double longest, double switch_time) {
    leg->mode = run->now.mode;
    leg->zero_of = -1;
    if (leg->mode == STICK) {
        stick_follow(leg, held, run, longest, switch_time);
    } else {
        slide_follow(leg, held, run, longest);
    }
}

static double no_travel(const void *motion, double t) {
    (void)motion;
    (void)t;
    return 0.0;
}

/* Moves on to the end of the leg, in its mode. */
static void leg_finish(const Leg *leg, const Plant *plant, Run *run) {
    Moment *now = &run->now;
    bool sticks = leg->mode == STICK, stops = leg->zero_of >= 0 && !sticks;
    const Slide *slide = &leg->motion.slide;
    double t = leg->t, travelled = 0.0;
    now->state = sticks ? stick_state(&leg->motion.stick, t) : slide_end(slide, t, &travelled);
    now->theta = period_advance(&now->means, t, now->theta, plant->drive_frequency, sticks,
                                sticks ? no_travel : slide_travel, slide, travelled);
    now->psi = within_turn(now->psi + plant->normal_frequency * t);
    now->position += travelled;
    now->event_age += t;
    if (is_sliding(leg->mode) && travelled * leg->mode > 0.0 && leg->mode != now->counts.sliding) {
        now->counts = counts_slid(now->counts, leg->mode);
    }
    if (stops) {
        now->state.velocity = 0.0;
        stop_note(stop_of(run, leg->mode), now->theta);
    }
}

static void begin_mode(Moment *moment, int mode) {
    if (mode != moment->mode) {
        moment->mode = mode;
        moment->counts = counts_begun(moment->counts, mode);
        moment->event_age = 0.0;
    }
}

/* The mode that follows on a leg. */
static void leg_succeed(const Leg *leg, const Plant *plant, Run *run, bool switches) {
    Moment *now = &run->now;
    bool released = leg->zero_of >= 0 && leg->mode == STICK;
    bool stopped = leg->zero_of >= 0 && leg->mode != STICK;
    int mode = leg->mode;
    if (released) {
        mode = leg->zero_of == 0 ? FORWARD : BACKWARD;
    } else if (stopped || (switches && mode == LIFTED)) {
        mode = mode_in_contact(plant, &now->state, now->theta, now->psi);
    } else if (switches) {
        mode = LIFTED;
    }
    run->leaving = released || (stopped && mode == leg->mode);
    begin_mode(now, mode);
}

bool coulomb_advance(const Held *held, const Moment *moment, double duration, Moment *after,
                     Refusal *refusal) {
    const Plant *plant = &held->plant;
    double remaining = duration;
    Clock clock = clock_of(duration);
    int stalled = 0;
    Run run = {*moment, moment->state.velocity == 0.0, stops_none()};
    Moment *now = &run.now;
    begin_mode(now, coulomb_mode_of(held, &now->state, now->theta, now->psi));
    while (remaining > 0.0) {
        Leg leg;
        double switch_time = time_to_switch(&held->window, now->psi + plant->phase,
                                            plant->normal_frequency, now->mode == LIFTED);
        leg_follow(&leg, held, &run, fmin(fmin(remaining, switch_time), held->arc), switch_time);
        leg_finish(&leg, plant, &run);
        leg_succeed(&leg, plant, &run, leg.t == switch_time);
        stalled = leg.t > STALLED * held->arc ? 0 : stalled + 1;
        if (stalled > MOST_STALLED) {
            return refuse_stalling(refusal, duration, clock.elapsed);
        }
        remaining = leg.t == remaining ? 0.0 : clock_advance(&clock, leg.t);
    }
    *after = *now;
    return true;
}
