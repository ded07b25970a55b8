#include "segment.h"

/* Tolerance of a series, in velocity scales: rounding. */
#define SERIES_ROUNDING (2.0 * EPSILON)

/* Sets all of a segment that begins at `now` but its motion. */
static void set_segment(Segment *segment, const Plant *plant, const Moment *now, int direction) {
    segment->mode = now->mode;
    segment->direction = direction;
    if (!segment->phasors.known) {
        segment->phasors = (KnownPhasors){true, phasors_of(plant, now)};
    }
}

/* Begins a series of relative `tolerance`; `bristle` is NULL for full friction. */
static void begin_series(Segment *segment, const System *system, const Bristle *bristle, const Moment *now,
                         double tolerance) {
    segment->by_series = true;
    taylor_slide_begin(&segment->motion.series, &system->plant, bristle, segment->direction, now,
                       &segment->phasors.phasors, tolerance);
}

void segment_begin_slide(Segment *segment, const System *system, const Moment *now, int direction) {
    const Plant *plant = &system->plant;
    const Split *split = &system->split;
    set_segment(segment, plant, now, direction);
    bool splits = system->splits;
    if (segment_rests(segment)) {
        segment->held = plant_held(plant);
        splits = split_prepare(&segment->held_split, &segment->held);
        split = &segment->held_split;
        plant = &segment->held;
    }
    if (!splits || plant->normal_rate != 0.0) {
        begin_series(segment, system, NULL, now, SERIES_ROUNDING);
        return;
    }
    segment->by_series = false;
    bending_panel_skip(&segment->motion.panel, split, plant, direction, now, &segment->phasors.phasors);
    segment->motion.panel.slide.works = segment->counts_means && now->mode != LIFTED;
}

void segment_begin_bending(Segment *segment, const System *system, const Moment *now, int direction, double longest,
                           double tolerance) {
    BendingPanel *panel = &segment->motion.panel;
    double error = tolerance * velocity_scale(&system->plant, &now->state);
    set_segment(segment, &system->plant, now, direction);
    BendingMotion motion =
        bending_panel_begin(panel, system, direction, now, &segment->phasors.phasors, longest, error);
    segment->by_series = false;
    if (motion == BY_SERIES) {
        begin_series(segment, system, &system->bristle, now, tolerance);
    } else if (motion == AS_BENT) {
        segment_begin_slide(segment, system, now, direction);
    } else if (segment->counts_means) {
        bending_panel_weigh(panel);
    }
}

/* Length of the panel [s] in which the motion begins and is sure to go on. */
static double panel_of(const Segment *segment) {
    return segment->by_series ? 0.0 : segment->motion.panel.length;
}

/* Time [s] from which on the motion is watched: the search could not leave the zero in which a release begins. */
static double watched_from(const Segment *segment) {
    double panel = panel_of(segment);
    if (!segment->from_rest || segment->direction == 0 || panel > 0.0) {
        return panel;
    }
    return segment->by_series ? taylor_slide_departure(&segment->motion.series, segment->t)
                              : split_slide_departure(&segment->motion.panel.slide);
}

bool segment_departs(Segment *segment) {
    if (segment->by_series) {
        return taylor_slide_departs(&segment->motion.series);
    }
    Watch watch = split_slide_watch(&segment->motion.panel.slide);
    return panel_of(segment) > 0.0 || watch.signal(watch.motion, 0.0).slope >= 0.0;
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
    if (segment->by_series) {
        return taylor_slide_watches(&segment->motion.series, segment->t, watches);
    }
    if (segment_rests(segment)) {
        return split_slide_margins(&segment->motion.panel.slide, segment->t, watches);
    }
    watches[0] = split_slide_watch(&segment->motion.panel.slide);
    return segment->direction != 0;
}

void segment_follow(Segment *segment, const Plant *plant, Moment *now, double longest) {
    segment->t = fmin(longest, segment->by_series ? segment->motion.series.reach : segment->motion.panel.reach);
    segment->zero_of = -1;
    segment->changes_direction = false;
    if (!(segment->t > 0.0)) {
        return;
    }
    Watch watches[2];
    int count = watches_of(segment, watches), direction = segment->direction;
    double expected = NO_ZERO, from = watched_from(segment);
    if (count == 2) {
        segment->t = fmin(segment->t, TAU / plant->drive_frequency); /* the other zero may come soon */
    }
    if (direction != 0) {
        expected = stop_expected(stop_after(&now->stops, direction), now->theta, plant->drive_frequency);
    }
    for (int i = 0; i < count; i++) {
        double zero = first_zero(&watches[i], segment->t, from, expected);
        if (zero >= 0.0) {
            segment->t = zero;
            segment->zero_of = i;
        }
    }
    segment->changes_direction = direction != 0 && segment->mode != LIFTED && direction != now->sliding &&
                                 (panel_of(segment) > 0.0 || moves(&watches[0], segment->t));
}

/* Where the motion of a segment is after `t` [s]. */
static Place place_of(const Segment *segment, double t) {
    return segment->by_series ? taylor_slide_place(&segment->motion.series, t, segment->counts_means)
                              : bending_panel_place(&segment->motion.panel, t);
}

static Passage passage_at(const void *motion, double t) {
    const Segment *segment = motion;
    return segment->by_series ? place_of(segment, t).passed : bending_panel_passage(&segment->motion.panel, t);
}

void segment_finish(Segment *segment, const Plant *plant, Moment *now) {
    Place end = place_of(segment, segment->t);
    now->state = end.state;
    segment->phasors = end.known;
    segment->from_rest = segment_released(segment);
    segment->phasors.known &= !segment_rests(segment); /* a step that ends at the release goes on in the same way */
    segment->travelled = end.passed.travel;
    if (segment->counts_means) {
        Interval interval = {segment->t, end.state.velocity, end.passed, segment_rests(segment), passage_at, segment};
        now->theta = period_advance(&now->means, &interval, now->theta, plant->drive_frequency);
    } else {
        now->theta = within_turn(now->theta + plant->drive_frequency * segment->t);
    }
    now->psi = within_turn(now->psi + turned_by(plant, segment->t));
    now->position += segment->travelled;
    if (segment->changes_direction) {
        now->reversals += now->sliding == -segment->direction;
        now->sliding = segment->direction;
        now->event_age = 0.0;
    }
    now->event_age += segment->t;
    if (segment_stopped(segment)) {
        now->state.velocity = 0.0;
        stop_record(stop_after(&now->stops, segment->direction), now->theta);
    }
}
