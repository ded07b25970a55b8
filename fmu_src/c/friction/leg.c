#include "leg.h"

/* Tolerance of a series, in velocity scales: rounding. */
#define SERIES_ROUNDING (2.0 * EPSILON)

/* Set all of a leg but its motion; the direction of sliding is watched `from` a time [s] on. */
static void set_leg(Leg *leg, LegKind kind, int mode, int direction, double from) {
    leg->kind = kind;
    leg->mode = mode;
    leg->direction = direction;
    leg->watched_from = from;
}

void leg_begin_rest(Leg *leg, const Plant *plant, const Moment *now) {
    set_leg(leg, RESTS, STICK, 0, 0.0);
    stick_begin(&leg->motion.stick, plant, now);
}

void leg_know_phasors(Leg *leg, const Plant *plant, const Moment *now) {
    if (!leg->known.known) {
        leg->known = (KnownPhasors){true, phasors_of(plant, now)};
    }
}

/* Sliding or flight by series with a bristle that is fully bent, which gives full friction. */
static void begin_bent(Leg *leg, const Plant *plant, const Moment *now) {
    const Bristle bent = {1.0, 0.0, 0.0};
    int sign = now->mode == LIFTED ? 0 : leg->direction;
    taylor_slide_begin(&leg->motion.series, plant, &bent, sign, &now->state, sign,
                       &leg->known.phasors, SERIES_ROUNDING, velocity_scale(plant, &now->state));
    leg->motion.series.direction = leg->direction; /* the velocity is watched in flight, too */
}

void leg_begin_slide(Leg *leg, const Law *law, const Moment *now, int direction) {
    const Plant *plant = &law->plant;
    bool splits = law->splits && plant->normal_rate == 0.0;
    set_leg(leg, splits ? SLIDES : FOLLOWS_SERIES, now->mode, direction, 0.0);
    leg_know_phasors(leg, plant, now);
    if (!splits) {
        begin_bent(leg, plant, now);
        return;
    }
    split_slide_begin(&leg->motion.slide, &law->split, plant, now, &leg->known.phasors, direction);
    leg->motion.slide.works = leg->counts_work && now->mode != LIFTED;
}

void leg_begin_bending(Leg *leg, const Law *law, const Moment *now, int direction, double longest,
                       double tolerance) {
    BendingPanel *panel = &leg->motion.panel;
    double scale = velocity_scale(&law->plant, &now->state);
    leg_know_phasors(leg, &law->plant, now);
    switch (bending_panel_begin(panel, law, direction, now, &leg->known.phasors, longest, tolerance * scale)) {
    case BY_SERIES:
        set_leg(leg, FOLLOWS_SERIES, now->mode, direction, 0.0);
        taylor_slide_begin(&leg->motion.series, &law->plant, &law->bristle, direction, &now->state,
                           now->bristle, &leg->known.phasors, tolerance, scale);
        return;
    case AS_BENT:
        leg_begin_slide(leg, law, now, direction);
        return;
    case BY_PANEL:
        set_leg(leg, BENDS_AND_SLIDES, now->mode, direction, panel->length);
        if (leg->counts_work) {
            bending_panel_weigh(panel);
        }
        return;
    }
}

bool leg_departs(Leg *leg) {
    if (leg->kind == BENDS_AND_SLIDES) {
        return true;
    }
    if (leg->kind == FOLLOWS_SERIES) {
        return taylor_slide_departs(&leg->motion.series);
    }
    Watch watch = split_slide_watch(&leg->motion.slide);
    return watch.signal(watch.motion, 0.0).slope >= 0.0;
}

/* Ends rest at the first release. With two candidates the search for one is limited to a turn, as the other
 * may come soon. */
static void follow_rest(Leg *leg, double turn) {
    Watch watches[2];
    int count = stick_watches(&leg->motion.stick, leg->t, watches);
    if (count > 0) {
        leg->t = fmin(leg->t, turn);
    }
    for (int i = 0; i < count; i++) {
        double zero = first_zero(&watches[i], leg->t, 0.0, NO_ZERO);
        if (zero >= 0.0) {
            leg->t = zero;
            leg->zero_of = i;
        }
    }
}

/* Whether a watched signal exceeds its noise before `t` [s]. In most cases its lower bound, a parabola, shows
 * that without another evaluation. */
static bool moves(const Watch *watch, double t) {
    Signal at = watch->signal(watch->motion, 0.0);
    double rising = at.bound * fmin(t, watch->horizon);
    if (at.slope > 0.0 && at.slope < rising &&
        at.value + 0.5 * at.slope * at.slope / at.bound > watch->noise) {
        return true;
    }
    return watch->signal(watch->motion, 0.5 * t).value > watch->noise;
}

/* The watched signal: the velocity in the direction of sliding. */
static Watch watch_of(Leg *leg) {
    if (leg->kind == FOLLOWS_SERIES) {
        return taylor_slide_watch(&leg->motion.series, leg->t);
    }
    return leg->kind == SLIDES ? split_slide_watch(&leg->motion.slide)
                               : split_slide_watch(&leg->motion.panel.slide);
}

/* Time [s] up to which the form of the motion holds. */
static double reach_of(const Leg *leg) {
    if (leg->kind == FOLLOWS_SERIES) {
        return leg->motion.series.reach;
    }
    return leg->kind == BENDS_AND_SLIDES ? leg->motion.panel.reach : INFINITY;
}

/* Ends sliding at a stop; sets `turns` if it moves in another direction than `before`. */
static void follow_sliding(Leg *leg, double expected, int before) {
    Watch watch = watch_of(leg);
    double zero = first_zero(&watch, leg->t, leg->watched_from, expected);
    if (zero >= 0.0) {
        leg->t = zero;
        leg->zero_of = 0;
    }
    leg->turns = leg->direction != before &&
                 (leg->kind == BENDS_AND_SLIDES || moves(&watch, leg->t));
}

void leg_follow(Leg *leg, const Plant *plant, Moment *now, double longest) {
    double frequency = plant->drive_frequency;
    leg->t = fmin(longest, reach_of(leg));
    leg->zero_of = -1;
    leg->turns = false;
    if (!(leg->t > 0.0)) {
        return;
    }
    if (leg->kind == RESTS) {
        follow_rest(leg, TAU / frequency);
    } else if (leg->direction != 0) {
        const Stop *stop = stop_after(&now->stops, leg->direction);
        follow_sliding(leg, stop_expected(stop, now->theta, frequency), now->counts.sliding);
    }
}

/* Where the motion of a leg is after `t` [s]. */
static Place place_of(const Leg *leg, double t) {
    Place place = {.known = {.known = false}};
    switch (leg->kind) {
    case RESTS:
        place.state = stick_state(&leg->motion.stick, t);
        return place;
    case SLIDES:
        return split_slide_place(&leg->motion.slide, t);
    case FOLLOWS_SERIES:
        place.state = taylor_slide_state(&leg->motion.series, t);
        place.passed = taylor_slide_passage(&leg->motion.series, t, leg->counts_work);
        return place;
    case BENDS_AND_SLIDES:
        return bending_panel_place(&leg->motion.panel, t);
    }
    return place;
}

static Passage passage_at(const void *motion, double t) {
    const Leg *leg = motion;
    return leg->kind == BENDS_AND_SLIDES ? bending_panel_passage(&leg->motion.panel, t)
                                         : place_of(leg, t).passed;
}

void leg_finish(Leg *leg, const Plant *plant, Moment *now) {
    Place end = place_of(leg, leg->t);
    now->state = end.state;
    leg->known = end.known;
    leg->travelled = end.passed.travel;
    Segment segment = {leg->t, end.state.velocity, end.passed, leg->kind == RESTS, passage_at, leg};
    now->theta = period_advance(&now->means, &segment, now->theta, plant->drive_frequency);
    now->psi = within_turn(now->psi + turned_by(plant, leg->t));
    now->position += leg->travelled;
    if (leg->turns) {
        now->counts.reversals += now->counts.sliding == -leg->direction;
        now->counts.sliding = leg->direction;
        now->event_age = 0.0;
    }
    now->event_age += leg->t;
    if (leg_stopped(leg)) {
        now->state.velocity = 0.0;
        stop_record(stop_after(&now->stops, leg->direction), now->theta);
    }
}
