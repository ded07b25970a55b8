#include "leap.h"

#include "../base/elementary.h"
#include "../base/runge_kutta.h"
#include "../device/device.h"

/* Fewest periods of a step: its six evaluations map half as many. */
#define SHORTEST_STEP (12.0 * DIFFERENCES)

/* First step of the solver, over the time in which rates change, where all that the slow velocity still changes by is the
 * tolerance: what it accepts in most devices. */
#define FIRST_STEP 3.3

/* Estimated error of a step that is accepted, in tolerances; by how much that estimate, of the embedded method of order 4,
 * exceeds the error. */
#define STEP_TOLERANCE 3.0
#define OVERESTIMATE 5.0

/* Share of the tolerance for errors of the fast states: on the manifold, and where a transient is left out. Such a transient
 * is so small, over the scales of the fast states, that outputs of the resonator do not show it. */
#define FAST_SHARE 0.3
#define MAX_TRANSIENT 1e-6

/* Part of the way to a grazing velocity that a step may pass: the rates are singular there. */
#define TO_GRAZING 0.5

/* Factor by which a step becomes shorter that meets a kink. */
#define ON_KINK 0.5

/* Largest drift of the load's phase [rad] in a step: an eighth of a beat, so that its stages see all phases. */
#define MAX_STEP_DRIFT (PI / 4.0)

/* Drift of the load's phase [rad] over a leap up to which its rates depend on the slow velocity alone. */
#define NO_DRIFT 1e-9

/* Change of the slow velocity up to which its rate may be linear, over v_q and the root of the tolerance. */
#define LINEAR 0.3

/* Largest decay of the slow velocity in a period, over the share of friction: beyond, it is noise. */
#define MAX_DECAY 4.0

/* A point of the slow motion, `n` periods after the start: the slow velocity [m/s], its rates, the moment there (`landing`)
 * and the one a few periods later (`after`). */
typedef struct {
    double n, velocity;
    SlowRates rates;
    Moment landing, after;
} Visited;

/* The slow motion from a moment at the section on, at normal phase `psi` [rad]. `varies`: its rates depend on time, too. Fast
 * states are extrapolated from two points, that where the present step begins (`here`) and the one found last. */
typedef struct {
    Manifold manifold;
    double psi;
    bool varies;
    Visited here, last;
} SlowMotion;

/* Periods on the tangent of a point to one at `n` periods and a slow velocity [m/s]: by the velocity, unless rates depend on
 * time or are no larger than their error. */
static double periods_from(const Visited *point, double n, double velocity, bool varies) {
    double acceleration = point->rates.acceleration;
    bool moves = fabs(acceleration) > point->rates.error;
    return moves && !varies ? (velocity - point->velocity) / acceleration : n - point->n;
}

/* Fast states at a point, along the tangent of the nearer one of two known points. */
static void guess_fast(const SlowMotion *motion, double n, double velocity, double fast[MAX_FAST]) {
    double to_here = periods_from(&motion->here, n, velocity, motion->varies);
    double to_last = periods_from(&motion->last, n, velocity, motion->varies);
    bool is_last = fabs(to_last) < fabs(to_here);
    const SlowRates *near = is_last ? &motion->last.rates : &motion->here.rates;
    for (int i = 0; i < MAX_FAST; i++) {
        fast[i] = near->fast[i] + (is_last ? to_last : to_here) * near->fast_rate[i];
    }
}

/* Whether rates are so exact that the slow velocity errs by no more than is allowed in the time in which friction changes it. */
static bool are_exact(const PeriodMap *map, const SlowRates *rates) {
    return rates->error <= map->share * map->tolerance * map->speed;
}

/* The rates at `n` periods and a slow velocity [m/s]. There are none where they are not exact enough, nor where sliding does
 * not repeat as it did at the start of the step: they have a kink in between. */
static bool rate_at(void *data, double n, double velocity, SlowRate *rate) {
    SlowMotion *motion = data;
    const PeriodMap *map = motion->manifold.map;
    Visited visited = {.n = n, .velocity = velocity, .landing = motion->here.landing};
    double fast[MAX_FAST];
    visited.landing.stops = motion->last.after.stops;
    guess_fast(motion, n, velocity, fast);
    moment_place(map, velocity, fast, psi_after(map, motion->psi, n), &visited.landing);
    if (!slow_rates(&motion->manifold, n, &visited.landing, &visited.after,
                    &visited.rates) ||
        !are_exact(map, &visited.rates) ||
        visited.rates.itinerary != motion->here.rates.itinerary) {
        return false;
    }
    motion->last = visited;
    *rate = (SlowRate){visited.rates.acceleration, visited.rates.travel};
    return true;
}

/* Periods that a step may pass of a beat, in which the load's phase drifts by a turn. */
static double in_beat(const SlowMotion *motion, double n) {
    return motion->varies ? MAX_STEP_DRIFT / fabs(drift_after(motion->manifold.map, n)) : INFINITY;
}

/* The step that the solver is expected to accept, in periods. */
static double first_step(const SlowMotion *motion) {
    const PeriodMap *map = motion->manifold.map;
    double acceleration = fabs(motion->here.rates.acceleration);
    double gain = fabs(motion->here.rates.jerk) / acceleration;
    double change = acceleration / (gain * map->speed);
    return gain > 0.0 ? FIRST_STEP / gain * pow(map->tolerance / change, 1.0 / ORDER) : INFINITY;
}

/* Largest transient of the fast states that may be left out, over their scales: its effect on the slow velocity, for as long
 * as it lasts, is a share of the tolerance. */
static double max_transient(const PeriodMap *map) {
    double effect = map->share / (1.0 - map->decay);
    return fmin(MAX_TRANSIENT, FAST_SHARE * map->tolerance / effect);
}

/* Put the start of a leap on the manifold. Return false where there are no rates. */
static bool place(SlowMotion *motion) {
    Manifold *manifold = &motion->manifold;
    const PeriodMap *map = manifold->map;
    Visited *here = &motion->here;
    bool placed = here->rates.offset <= FAST_SHARE * map->tolerance && are_exact(map, &here->rates);
    SlowRate rate;
    manifold->max_sequences = MAX_SEQUENCES;
    manifold->allowed = FAST_SHARE * map->tolerance;
    motion->last = *here;
    if (!placed && !rate_at(motion, 0.0, here->velocity, &rate)) {
        return false;
    }
    *here = motion->last;
    return true;
}

/* Periods that the next step passes, of `h` that are wanted: a whole number. */
static double step_of(const SlowMotion *motion, const SlowPoint *now, double h, double longest) {
    const PeriodMap *map = motion->manifold.map;
    double distance = fabs(fabs(now->velocity) - map->speed);
    double to_grazing = TO_GRAZING * distance / fabs(now->rate.acceleration);
    return floor(fmin(fmin(h, in_beat(motion, now->t)), fmin(to_grazing, longest - now->t)));
}

/* The error of the slow velocity [m/s] behind a step: what there was before has decayed as differences of velocity do, and the
 * step adds that of the solver and that of the rates. */
static double error_behind(const SlowMotion *motion, const SlowStep *step, double of_step, double h,
                           double before) {
    double gain = fmax(step->gain, -MAX_DECAY * motion->manifold.map->share);
    double decay = gain < 0.0 ? exp(gain * h) : 1.0;
    double of_rates = fmax(motion->here.rates.error, motion->last.rates.error);
    return decay * before + of_step + h * of_rates;
}

/* The rest of a leap of `h` periods in one step, near a steady velocity. Return whether that holds. */
static bool settles(SlowMotion *motion, const SlowPoint *from, double h, SlowStep *step) {
    const PeriodMap *map = motion->manifold.map;
    const SlowRates *rates = &motion->here.rates;
    double most = LINEAR * sqrt(map->tolerance) * map->speed;
    return !motion->varies &&
           linear_step(rate_at, motion, from, rates->jerk / rates->acceleration, h, most, step) &&
           step->error <= map->tolerance * map->speed;
}

/* Integrate the slow motion over at most `longest` periods, as far as that goes. `error` is that of the slow velocity. */
static SlowPoint integrate(SlowMotion *motion, double longest, double *error) {
    const PeriodMap *map = motion->manifold.map;
    Visited *here = &motion->here;
    double allowed = STEP_TOLERANCE * map->tolerance * map->speed, h = first_step(motion);
    SlowPoint now = {.velocity = here->velocity,
                     .rate = {here->rates.acceleration, here->rates.travel}};
    while ((h = step_of(motion, &now, h, longest)) >= SHORTEST_STEP) {
        SlowStep step;
        Visited before = *here;
        double rest = longest - now.t;
        bool is_linear = settles(motion, &now, rest, &step);
        bool found = is_linear || (runge_kutta_step(rate_at, motion, &now, h, &step) && isfinite(step.error));
        if (found && step.error <= allowed) {
            double of_step = is_linear ? step.error : step.error / OVERESTIMATE;
            h = step.to.t - now.t;
            *error = error_behind(motion, &step, of_step, h, *error);
            now = step.to;
            *here = motion->last;
        }
        motion->last = before;
        h *= found ? step_growth(step.error, allowed) : ON_KINK;
    }
    return now;
}

/* The moment behind the landing. All periods of a leap have the same events. */
static void land(const SlowMotion *motion, const SlowPoint *end, Moment *after) {
    const Visited *here = &motion->here;
    double period = motion->manifold.map->period;
    *after = here->after;
    after->position += end->travel;
    after->counts.reversals += end->t * here->rates.reversals;
    after->counts.sticks += end->t * here->rates.sticks;
    if (after->event_age > DIFFERENCES * period) {
        after->event_age += end->t * period;
    }
}

Leap leap(const PeriodMap *map, const Moment *moment, double longest, Budget *budget,
          Moment *after) {
    SlowMotion motion = {
        .manifold = {map, budget, 1, max_transient(map), 0},
        .psi = moment->psi,
        .varies = fabs(map->drift) * longest > NO_DRIFT || is_ramped(&map->law.held.plant),
        .here = {.velocity = momentum_velocity(map, moment), .landing = *moment},
    };
    Manifold *manifold = &motion.manifold;
    Visited *here = &motion.here;
    Leap done = {.outcome = NO_GAIN, .periods = DIFFERENCES};
    double error = moment->leap_error;
    bool found = slow_rates(manifold, 0.0, &here->landing, &here->after, &here->rates);
    if (!found && isinf(here->rates.offset)) {
        *after = *moment;
        return (Leap){.outcome = NO_GAIN};
    }
    *after = here->after;
    if (!found) {
        done.outcome = NOT_ON_MANIFOLD;
        done.wait = log(here->rates.offset / manifold->allowed) / -log(map->decay);
        return done;
    }
    if (place(&motion)) {
        SlowPoint end = integrate(&motion, longest - DIFFERENCES, &error);
        if (end.t > 0.0) {
            land(&motion, &end, after);
            after->leap_error = error;
            done.outcome = LEAPT;
            done.periods = end.t + DIFFERENCES;
        }
    }
    done.in_vain = (int)fmax(0.0, manifold->maps - done.periods);
    return done;
}
