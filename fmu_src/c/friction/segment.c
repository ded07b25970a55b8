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

void segment_begin_rest(Segment *segment, const Plant *plant, const Moment *now) {
    set_segment(segment, RESTS, STICK, 0, 0.0);
    stick_begin(&segment->motion.stick, plant, now);
}

void segment_know_phasors(Segment *segment, const Plant *plant, const Moment *now) {
    if (!segment->known.known) {
        segment->known = (KnownPhasors){true, phasors_of(plant, now)};
    }
}

/* Sliding or flight by series with a bristle that is fully bent, which gives full friction. */
static void begin_bent(Segment *segment, const Plant *plant, const Moment *now) {
    const Bristle bent = {1.0, 0.0, 0.0};
    int sign = now->mode == LIFTED ? 0 : segment->direction;
    taylor_slide_begin(&segment->motion.series, plant, &bent, sign, &now->state, sign, &segment->known.phasors,
                       SERIES_ROUNDING, velocity_scale(plant, &now->state));
    segment->motion.series.direction = segment->direction; /* the velocity is watched in flight, too */
}

void segment_begin_slide(Segment *segment, const System *system, const Moment *now, int direction) {
    const Plant *plant = &system->plant;
    bool splits = system->splits && plant->normal_rate == 0.0;
    set_segment(segment, splits ? SLIDES : FOLLOWS_SERIES, now->mode, direction, 0.0);
    segment_know_phasors(segment, plant, now);
    if (!splits) {
        begin_bent(segment, plant, now);
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
        taylor_slide_begin(&segment->motion.series, &system->plant, &system->bristle, direction, &now->state,
                           now->bristle, &segment->known.phasors, tolerance, scale);
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

/* Ends rest at the first release. With two candidates the search for one is limited to a turn, as the other may come
 * soon. */
static void follow_rest(Segment *segment, double turn) {
    Watch watches[2];
    int count = stick_watches(&segment->motion.stick, segment->t, watches);
    if (count > 0) {
        segment->t = fmin(segment->t, turn);
    }
    for (int i = 0; i < count; i++) {
        double zero = first_zero(&watches[i], segment->t, 0.0, NO_ZERO);
        if (zero >= 0.0) {
            segment->t = zero;
            segment->zero_of = i;
        }
    }
}

/* Whether a watched signal exceeds its noise before `t` [s]. In most cases its lower bound, a parabola, shows that
 * without another evaluation. */
static bool moves(const Watch *watch, double t) {
    Signal at = watch->signal(watch->motion, 0.0);
    double rising = at.bound * fmin(t, watch->horizon);
    if (at.slope > 0.0 && at.slope < rising && at.value + 0.5 * at.slope * at.slope / at.bound > watch->noise) {
        return true;
    }
    return watch->signal(watch->motion, 0.5 * t).value > watch->noise;
}

/* The watched signal: the velocity in the direction of sliding. */
static Watch watch_of(Segment *segment) {
    if (segment->kind == FOLLOWS_SERIES) {
        return taylor_slide_watch(&segment->motion.series, segment->t);
    }
    return segment->kind == SLIDES ? split_slide_watch(&segment->motion.slide)
                                   : split_slide_watch(&segment->motion.panel.slide);
}

/* Time [s] up to which the form of the motion holds. */
static double reach_of(const Segment *segment) {
    if (segment->kind == FOLLOWS_SERIES) {
        return segment->motion.series.reach;
    }
    return segment->kind == BENDS_AND_SLIDES ? segment->motion.panel.reach : INFINITY;
}

/* Ends sliding or flight at a stop; sets `turns` if it slides in another direction than `before`. */
static void follow_sliding(Segment *segment, double expected, int before) {
    Watch watch = watch_of(segment);
    double zero = first_zero(&watch, segment->t, segment->watched_from, expected);
    if (zero >= 0.0) {
        segment->t = zero;
        segment->zero_of = 0;
    }
    segment->turns = segment->mode != LIFTED && segment->direction != before &&
                     (segment->kind == BENDS_AND_SLIDES || moves(&watch, segment->t));
}

void segment_follow(Segment *segment, const Plant *plant, Moment *now, double longest) {
    double frequency = plant->drive_frequency;
    segment->t = fmin(longest, reach_of(segment));
    segment->zero_of = -1;
    segment->turns = false;
    if (!(segment->t > 0.0)) {
        return;
    }
    if (segment->kind == RESTS) {
        follow_rest(segment, TAU / frequency);
    } else if (segment->direction != 0) {
        const Stop *stop = stop_after(&now->stops, segment->direction);
        follow_sliding(segment, stop_expected(stop, now->theta, frequency), now->counts.sliding);
    }
}

/* Where the motion of a segment is after `t` [s]. */
static Place place_of(const Segment *segment, double t) {
    Place place = {.known = {.known = false}};
    switch (segment->kind) {
    case RESTS:
        place.state = stick_state(&segment->motion.stick, t);
        return place;
    case SLIDES:
        return split_slide_place(&segment->motion.slide, t);
    case FOLLOWS_SERIES:
        place.state = taylor_slide_state(&segment->motion.series, t);
        place.passed = taylor_slide_passage(&segment->motion.series, t, segment->counts_means);
        return place;
    case BENDS_AND_SLIDES:
        return bending_panel_place(&segment->motion.panel, t);
    }
    return place;
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
        Interval interval = {segment->t, end.state.velocity, end.passed, segment->kind == RESTS, passage_at, segment};
        now->theta = period_advance(&now->means, &interval, now->theta, plant->drive_frequency);
    } else {
        now->theta = within_turn(now->theta + plant->drive_frequency * segment->t);
    }
    now->psi = within_turn(now->psi + turned_by(plant, segment->t));
    now->position += segment->travelled;
    if (segment->turns) {
        now->counts.reversals += now->counts.sliding == -segment->direction;
        now->counts.sliding = segment->direction;
        now->event_age = 0.0;
    }
    now->event_age += segment->t;
    if (segment_stopped(segment)) {
        now->state.velocity = 0.0;
        stop_record(stop_after(&now->stops, segment->direction), now->theta);
    }
}
