#include "segment.h"

/* Tolerance of a series, in velocity scales: rounding. */
#define SERIES_ROUNDING (2.0 * EPSILON)

/* Set all of a segment but its motion; the direction of sliding is watched `from` a time [s] on. */
static void set_segment(Segment *segment, SegmentKind kind, int mode, int direction, double from) {
    segment->kind = kind;
    segment->mode = mode;
    segment->direction = direction;
    segment->watched_from = from;
}

void segment_know_phasors(Segment *segment, const Plant *plant, const Moment *now) {
    if (!segment->known.known) {
        segment->known = (KnownPhasors){true, phasors_of(plant, now)};
    }
}

void segment_begin_slide(Segment *segment, const System *system, const Moment *now, int direction) {
    const Plant *plant = &system->plant;
    bool rests = now->mode == STICK && direction == 0;
    bool splits = system->splits && plant->normal_rate == 0.0 && !rests;
    set_segment(segment, splits ? SLIDES : FOLLOWS_SERIES, now->mode, direction, 0.0);
    segment_know_phasors(segment, plant, now);
    if (!splits) {
        taylor_slide_begin(&segment->motion.series, plant, NULL, direction, now, &segment->known.phasors,
                           SERIES_ROUNDING);
        return;
    }
    split_slide_begin(&segment->motion.slide, &system->split, plant, now, &segment->known.phasors, direction);
    segment->motion.slide.works = segment->counts_means && now->mode != LIFTED;
}

void segment_begin_bending(Segment *segment, const System *system, const Moment *now, int direction, double longest,
                           double tolerance) {
    BendingPanel *panel = &segment->motion.panel;
    double scale = velocity_scale(&system->plant, &now->state);
    segment_know_phasors(segment, &system->plant, now);
    switch (bending_panel_begin(panel, system, direction, now, &segment->known.phasors, longest, tolerance * scale)) {
    case BY_SERIES:
        set_segment(segment, FOLLOWS_SERIES, now->mode, direction, 0.0);
        taylor_slide_begin(&segment->motion.series, &system->plant, &system->bristle, direction, now,
                           &segment->known.phasors, tolerance);
        return;
    case AS_BENT:
        segment_begin_slide(segment, system, now, direction);
        return;
    case BY_PANEL:
        set_segment(segment, BENDS_AND_SLIDES, now->mode, direction, panel->length);
        if (segment->counts_means) {
            bending_panel_weigh(panel);
        }
        return;
    }
}

bool segment_departs(Segment *segment) {
    if (segment->kind == BENDS_AND_SLIDES) {
        return true;
    }
    if (segment->kind == FOLLOWS_SERIES) {
        return taylor_slide_departs(&segment->motion.series);
    }
    Watch watch = split_slide_watch(&segment->motion.slide);
    return watch.signal(watch.motion, 0.0).slope >= 0.0;
}

/* Whether a watched signal exceeds its noise before `t` [s]. In most cases its lower bound, a parabola, shows that
 * without another evaluation. */
static bool moves(const Watch *watch, double t) {
    Signal at = watch->signal(watch->motion, 0.0);
    double rising = at.bound * t;
    if (at.slope > 0.0 && at.slope < rising && at.value + 0.5 * at.slope * at.slope / at.bound > watch->noise) {
        return true;
    }
    return watch->signal(watch->motion, 0.5 * t).value > watch->noise;
}

/* What is watched: the velocity in the direction of sliding or, at rest, both margins of friction. Return the number of
 * watches. */
static int watches_of(Segment *segment, Watch watches[2]) {
    if (segment->kind == FOLLOWS_SERIES) {
        return taylor_slide_watches(&segment->motion.series, segment->t, watches);
    }
    watches[0] = split_slide_watch(segment->kind == SLIDES ? &segment->motion.slide : &segment->motion.panel.slide);
    return segment->direction != 0;
}

/* Time [s] up to which the form of the motion holds. */
static double reach_of(const Segment *segment) {
    if (segment->kind == FOLLOWS_SERIES) {
        return segment->motion.series.reach;
    }
    return segment->kind == BENDS_AND_SLIDES ? segment->motion.panel.reach : INFINITY;
}

void segment_follow(Segment *segment, const Plant *plant, Moment *now, double longest) {
    segment->t = fmin(longest, reach_of(segment));
    segment->zero_of = -1;
    segment->turns = false;
    if (!(segment->t > 0.0)) {
        return;
    }
    Watch watches[2];
    int count = watches_of(segment, watches), direction = segment->direction;
    double expected = NO_ZERO;
    if (direction != 0) {
        expected = stop_expected(stop_after(&now->stops, direction), now->theta, plant->drive_frequency);
    }
    for (int i = 0; i < count; i++) {
        double zero = first_zero(&watches[i], segment->t, segment->watched_from, expected);
        if (zero >= 0.0) {
            segment->t = zero;
            segment->zero_of = i;
        }
    }
    segment->turns = direction != 0 && segment->mode != LIFTED && direction != now->counts.sliding &&
                     (segment->kind == BENDS_AND_SLIDES || moves(&watches[0], segment->t));
}

/* Where the motion of a segment is after `t` [s]. */
static Place place_of(const Segment *segment, double t) {
    if (segment->kind == FOLLOWS_SERIES) {
        return taylor_slide_place(&segment->motion.series, t, segment->counts_means);
    }
    return segment->kind == SLIDES ? split_slide_place(&segment->motion.slide, t)
                                   : bending_panel_place(&segment->motion.panel, t);
}

static Passage passage_at(const void *motion, double t) {
    const Segment *segment = motion;
    return segment->kind == BENDS_AND_SLIDES ? bending_panel_passage(&segment->motion.panel, t)
                                             : place_of(segment, t).passed;
}

void segment_finish(Segment *segment, const Plant *plant, Moment *now) {
    Place end = place_of(segment, segment->t);
    now->state = end.state;
    segment->known = end.known;
    segment->travelled = end.passed.travel;
    if (segment->counts_means) {
        Interval interval = {segment->t, end.state.velocity, end.passed, segment_rests(segment), passage_at, segment};
        now->theta = period_advance(&now->means, &interval, now->theta, plant->drive_frequency);
    } else {
        now->theta = within_turn(now->theta + plant->drive_frequency * segment->t);
    }
    now->psi = within_turn(now->psi + turned_by(plant, segment->t));
    now->position += segment->travelled;
    if (segment->turns) {
        now->counts.reversals += now->counts.sliding == -segment->direction;
        now->counts.sliding = segment->direction;
    }
    if (segment_reverses(segment)) {
        now->event_age = 0.0;
    }
    now->event_age += segment->t;
    if (segment_stopped(segment)) {
        now->state.velocity = 0.0;
        stop_record(stop_after(&now->stops, segment->direction), now->theta);
    }
}
