/* Turns of a split slide: exp(i w t), exp(i q t) and exp(lambda t), by rotation of turns that are known, or
 * by sines and cosines.
 *
 * All in a header, so that compilers inline it: calls would cost 1.5 % of the instructions of a run. */
#ifndef SLIDER_SPLIT_TURNS_H
#define SLIDER_SPLIT_TURNS_H

#include <math.h>

#include "elementary_functions.h"
#include "split_slide.h"

/* Angle [rad] of the fastest oscillation up to which turns are rotated: the series below are then exact to
 * rounding. */
#define SMALL_TURN 0x1p-7

/* Whether `t` [s] is close to the start. */
static inline bool is_soon(const SplitSlide *slide, double t) {
    return t * slide->split->fastest < SMALL_TURN;
}

/* exp(i theta), without a sine at the end of a turn, where means over a period need it. */
static Complex drive_at(double theta) {
    double passed = theta - TAU;
    return fabs(passed) < 1e-9 ? complex_of(1.0, passed) : complex_rect(1.0, theta);
}

/* Turns at `t`, by sines and cosines. */
static void compute_turns(const SplitSlide *slide, double t, Turns *turns) {
    const Plant *plant = slide->plant;
    turns->t = t;
    turns->free = complex_of(1.0, 0.0);
    turns->envelope = 1.0;
    if (plant->resolves_resonator) {
        Complex eigenvalue = plant->slip.eigenvalue;
        turns->envelope = elementary_exp(eigenvalue.re * t);
        turns->free = complex_rect(turns->envelope, eigenvalue.im * t);
    }
    turns->phasors.drive = drive_at(slide->theta + plant->drive_frequency * t);
    turns->phasors.normal = slide->split->merges
                                ? slide->start.phasors.normal
                                : complex_rect(1.0, slide->chi + plant->normal_frequency * t);
}

/* `z` exp(i angle) for a small `angle` [rad]. */
static inline Complex rotated(Complex z, double angle) {
    double square = angle * angle;
    double versed = square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0)));
    double sine = angle * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0)));
    return complex_of(z.re - (versed * z.re + sine * z.im), z.im + (sine * z.re - versed * z.im));
}

/* exp(x) for a small `x`. */
static inline double grown(double x) {
    double tail = 1.0 / 24.0 + x * (1.0 / 120.0 + x * (1.0 / 720.0));
    return 1.0 + x * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x * tail)));
}

/* Turns at the time of `anchor`, rotated to the close time `t`. */
static inline void rotate_turns(const SplitSlide *slide, const Turns *anchor, double t,
                                Turns *turns) {
    const Plant *plant = slide->plant;
    double ahead = t - anchor->t;
    turns->t = t;
    turns->free = anchor->free;
    turns->envelope = anchor->envelope;
    if (plant->resolves_resonator) {
        Complex eigenvalue = plant->slip.eigenvalue;
        double growth = grown(eigenvalue.re * ahead);
        turns->envelope *= growth;
        turns->free = complex_scale(growth, rotated(anchor->free, eigenvalue.im * ahead));
    }
    turns->phasors.drive = rotated(anchor->phasors.drive, plant->drive_frequency * ahead);
    turns->phasors.normal = slide->split->merges
                                ? anchor->phasors.normal
                                : rotated(anchor->phasors.normal, plant->normal_frequency * ahead);
}

/* Turns at `t`: rotated from the start or the anchor (in `place`), or computed (in `fresh`). Close to the
 * start they are always rotated, so that rounding errors are those of the start: a slider that sets out
 * must not seem to move back. */
static inline const Turns *turns_at(const SplitSlide *slide, double t, Turns *place,
                                    Turns *fresh) {
    if (t == 0.0) {
        return &slide->start;
    }
    if (is_soon(slide, t)) {
        rotate_turns(slide, &slide->start, t, place);
        return place;
    }
    if (slide->anchored && fabs(t - slide->anchor.t) * slide->split->fastest < SMALL_TURN) {
        rotate_turns(slide, &slide->anchor, t, place);
        return place;
    }
    compute_turns(slide, t, fresh);
    return fresh;
}

#endif
