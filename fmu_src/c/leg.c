#include "leg.h"

#include <math.h>

#include "angle.h"
#include "velocity_scale.h"

/* Error of one series in velocity scales: that of rounding. */
#define SERIES_ROUNDING (2.0 * EPSILON)

void leg_begin_rest(Leg *leg, const Held *held, const Moment *now) {
    leg->kind = RESTS;
    leg->mode = STICK;
    leg->direction = 0;
    leg->watched_from = 0.0;
    stick_begin(&leg->motion.stick, &held->plant, &now->state, now->theta,
                now->psi + held->plant.phase);
}

/* Sliding or flight under a normal load whose frequency changes. A stiff bristle that is fully bent is
 * full friction. */
static void begin_chirped(Leg *leg, const Plant *plant, const Moment *now, int sign) {
    const Bristle bent = {1.0, 0.0, 0.0};
    double tolerance = SERIES_ROUNDING * velocity_scale(plant, &now->state);
    leg->kind = FOLLOWS_SERIES;
    leg->known.known = false;
    taylor_slide_begin(&leg->motion.series, plant, &bent, sign, &now->state, sign, now->theta,
                       now->psi + plant->phase, tolerance);
    leg->motion.series.direction = leg->direction; /* watched in flight, too */
}

void leg_begin_slide(Leg *leg, const Held *held, const Moment *now, int direction) {
    int sign = now->mode == LIFTED ? 0 : direction;
    leg->mode = now->mode;
    leg->direction = direction;
    leg->watched_from = 0.0;
    if (held->plant.normal_rate != 0.0) {
        begin_chirped(leg, &held->plant, now, sign);
        return;
    }
    leg->kind = SLIDES;
    slide_begin(&leg->motion.slide, held, sign, &now->state, now->theta,
                now->psi + held->plant.phase, &leg->known, direction);
}

void leg_begin_bending(Leg *leg, const Held *held, const Bristle *bristle, const Moment *now,
                       int direction, double tolerance) {
    leg->kind = FOLLOWS_SERIES;
    leg->mode = now->mode;
    leg->direction = direction;
    leg->watched_from = 0.0;
    taylor_slide_begin(&leg->motion.series, &held->plant, bristle, direction, &now->state,
                       now->bristle, now->theta, now->psi + held->plant.phase, tolerance);
}

bool leg_departs(Leg *leg) {
    if (leg->kind == FOLLOWS_SERIES) {
        return taylor_slide_departs(&leg->motion.series);
    }
    Watch watch = slide_watch(&leg->motion.slide);
    return watch.signal(watch.motion, 0.0).slope >= 0.0;
}

/* Ends rest at the release that comes first. One release is searched for over a turn at most, as the
 * other may come soon. */
static void follow_rest(Leg *leg, double turn) {
    Watch watches[2];
    int count = stick_watches(&leg->motion.stick, leg->t, watches);
    if (count > 0) {
        leg->t = fmin(leg->t, turn);
    }
    for (int i = 0; i < count; i++) {
        double zero = first_zero(&watches[i], leg->t, 0.0);
        if (zero >= 0.0) {
            leg->t = zero;
            leg->zero_of = i;
        }
    }
}

/* Whether a watched signal exceeds its noise before `t` [s]. A parabola that is below it shows that at
 * once, most often. */
static bool moves(const Watch *watch, double t) {
    Signal at = watch->signal(watch->motion, 0.0);
    double rising = at.bound * fmin(t, watch->horizon);
    if (at.slope > 0.0 && at.slope < rising &&
        at.value + 0.5 * at.slope * at.slope / at.bound > watch->noise) {
        return true;
    }
    return watch->signal(watch->motion, 0.5 * t).value > watch->noise;
}

/* Ends sliding at a stop; tells whether it goes in another direction than `before`. */
static void follow_sliding(Leg *leg, double expected, int before) {
    Watch watch = leg->kind == FOLLOWS_SERIES ? taylor_slide_watch(&leg->motion.series, leg->t)
                                     : slide_watch(&leg->motion.slide);
    double zero = first_zero_near(&watch, leg->t, leg->watched_from, expected);
    if (zero >= 0.0) {
        leg->t = zero;
        leg->zero_of = 0;
    }
    leg->turns = leg->direction != before && moves(&watch, leg->t);
}

void leg_follow(Leg *leg, const Held *held, Moment *now, double longest) {
    double frequency = held->plant.drive_frequency;
    leg->t = leg->kind == FOLLOWS_SERIES ? fmin(longest, leg->motion.series.reach) : longest;
    leg->zero_of = -1;
    leg->turns = false;
    if (!(leg->t > 0.0)) {
        return;
    }
    if (leg->kind == RESTS) {
        follow_rest(leg, TAU / frequency);
    } else if (leg->direction != 0) {
        const Stop *stop = stop_after(&now->stops, leg->direction);
        follow_sliding(leg, stop_expected(stop, now->theta, frequency),
                       now->counts.sliding);
    }
}

static double travel_at(const void *motion, double t) {
    const Leg *leg = motion;
    switch (leg->kind) {
    case RESTS:
        return 0.0;
    case SLIDES:
        return slide_travel(&leg->motion.slide, t);
    case FOLLOWS_SERIES:
        return taylor_slide_travel(&leg->motion.series, t);
    }
    return NAN;
}

/* The state at the end of the leg; takes down how far it goes. */
static State end_of(Leg *leg) {
    State state = {NAN, NAN, NAN};
    leg->known.known = false;
    switch (leg->kind) {
    case RESTS:
        leg->travelled = 0.0;
        return stick_state(&leg->motion.stick, leg->t);
    case SLIDES:
        return slide_end(&leg->motion.slide, leg->t, &leg->travelled, &leg->known);
    case FOLLOWS_SERIES:
        leg->travelled = taylor_slide_travel(&leg->motion.series, leg->t);
        return taylor_slide_state(&leg->motion.series, leg->t);
    }
    return state;
}

void leg_finish(Leg *leg, const Held *held, Moment *now) {
    const Plant *plant = &held->plant;
    now->state = end_of(leg);
    Segment segment = {leg->t, leg->travelled, now->state.velocity, leg->kind == RESTS, travel_at, leg};
    now->theta = period_advance(&now->means, &segment, now->theta, plant->drive_frequency);
    now->psi = within_turn(now->psi + turned_by(plant, leg->t));
    now->position += leg->travelled;
    if (leg->turns) {
        now->counts = counts_slid(now->counts, leg->direction);
        now->event_age = 0.0;
    }
    now->event_age += leg->t;
    if (leg_stopped(leg)) {
        now->state.velocity = 0.0;
        stop_record(stop_after(&now->stops, leg->direction), now->theta);
    }
}
