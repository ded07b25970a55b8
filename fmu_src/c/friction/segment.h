/* A segment: motion without an event, at rest, sliding or in flight, up to the first zero of what it watches. */
#pragma once

#include "bending_panel.h"
#include "taylor_slide.h"

/* Begun by a friction law, then followed, up to the first zero of what it watches. */
typedef struct Segment {
    bool by_series; /* whether the motion is a series, or in closed form, after a panel or not */
    int mode;       /* contact mode */
    int direction;  /* of sliding, in which the velocity is watched; 0 for none */
    Plant held;     /* at rest, the plant of the held slider, and its closed form */
    Split held_split;
    union {
        TaylorSlide series;
        BendingPanel panel;
    } motion;
    double t;               /* duration [s] once followed */
    double travelled;       /* displacement of the slider [m] once finished */
    int zero_of;            /* index of the watched signal whose zero ends it, or -1 */
    bool from_rest;         /* set before: whether it begins at a release */
    bool changes_direction; /* whether it slides, beyond rounding, in another direction than it slid before */
    bool counts_means; /* set before: whether it counts in the means of a period; the work of friction is 0 otherwise */
    KnownPhasors phasors; /* set before: the phasors of the start, if they are known; once finished, of the end */
} Segment;

/* Sliding in `direction` under full friction, flight in contact mode LIFTED, or rest in contact with direction 0: in
 * closed form, or by series where there is none. */
void segment_begin_slide(Segment *segment, const System *system, const Moment *now, int direction);

/* Sliding in `direction` while a bristle bends, to a relative `tolerance`, for up to `longest` [s]. */
void segment_begin_bending(Segment *segment, const System *system, const Moment *now, int direction, double longest,
                           double tolerance);

/* Whether a slider at rest begins to move in the direction of the segment, or not at all. */
bool segment_departs(Segment *segment);

/* Follows the segment until it ends, for up to `longest` [s]. */
void segment_follow(Segment *segment, const Plant *plant, Moment *now, double longest);

/* Whether the slider rests. */
static inline bool segment_rests(const Segment *segment) {
    return segment->mode == STICK && segment->direction == 0;
}

/* Whether the segment ended at a stop of the slider, and whether at a release of it. */
static inline bool segment_stopped(const Segment *segment) {
    return segment->zero_of >= 0 && !segment_rests(segment);
}

static inline bool segment_released(const Segment *segment) {
    return segment->zero_of >= 0 && segment_rests(segment);
}

/* Moves on to the end of the segment, in its mode. */
void segment_finish(Segment *segment, const Plant *plant, Moment *now);
