#include "leap.h"

#include "../base/elementary.h"
#include "slow_step.h"

/* Share of the tolerance for errors of the fast states: on the manifold, and where a transient is left out. */
#define FAST_SHARE 0.3

/* Largest transient that a leap may leave out, over the scales of the fast states: outputs of the resonator do not show
 * it. */
#define MAX_TRANSIENT 1e-6

/* Drift of the load's phase [rad] over a leap up to which its rates depend on the slow velocity alone. */
#define NO_DRIFT 1e-9

/* Number of steps of leaps that a whole budget buys, besides what they map: some map nothing. */
enum { MAX_LEAP_STEPS = 20000 };

/* Largest transient of the fast states that may be left out, over their scales: its effect on the slow velocity, for as
 * long as it lasts, is a share of the tolerance. */
static double max_transient(const PeriodMap *map) {
    double effect = map->share / (1.0 - map->decay);
    return fmin(MAX_TRANSIENT, FAST_SHARE * map->tolerance / effect);
}

/* Put the start of a leap on the manifold. Return false where there are no rates, and without a search where they would
 * not be exact enough on the manifold either. */
static bool begin_on_manifold(SlowPath *path) {
    Manifold *manifold = &path->manifold;
    const PeriodMap *map = manifold->map;
    PathPoint *here = &path->here;
    bool placed = here->rates.offset <= FAST_SHARE * map->tolerance && are_exact(map, &here->rates);
    SlowRates on_manifold = {.error = here->rates.error - map->share * map->speed * here->rates.offset};
    if (!are_exact(map, &on_manifold)) {
        return false;
    }
    manifold->max_sequences = MAX_SEQUENCES;
    manifold->allowed = FAST_SHARE * map->tolerance;
    path->last = *here;
    if (!placed && !evaluate(path, 0.0, here->velocity)) {
        return false;
    }
    begin_step(path);
    return true;
}

/* Pass at most `longest` periods, as far as that goes. Return how many, and the `travel` [m] in them; `error` is that
 * of the slow velocity [m/s]. */
static double take_steps(SlowPath *path, double longest, double *travel, double *error) {
    double passed = 0.0, h = path->varies ? expected_step(path) : longest;
    *travel = 0.0;
    Budget *budget = path->manifold.budget;
    while ((h = floor(fmin(h, longest - passed))) >= SHORTEST_STEP && budget_left(budget, MAX_LEAP_STEPS) > 0) {
        PathStep step;
        budget_spend(budget, 1, MAX_LEAP_STEPS);
        bool passes = path->varies ? embedded_step(path, &h, &step) : interpolated_step(path, &h, &step);
        if (passes) {
            passed += step.periods;
            *travel += step.travel;
            *error = step.factor * *error + step.error;
            path->last.n = passed;
        } else {
            path->last = path->here;
        }
        begin_step(path);
    }
    return passed;
}

/* The moment behind the landing. All periods of a leap have the same events. */
static void land(const SlowPath *path, double periods, double travel, Moment *after) {
    const PathPoint *here = &path->here;
    double period = path->manifold.map->period;
    *after = here->after;
    after->psi = psi_after(path->manifold.map, path->psi, periods + DIFFERENCES);
    after->position += travel;
    after->reversals += periods * here->rates.reversals;
    if (after->event_age > DIFFERENCES * period) {
        after->event_age += periods * period;
    }
}

Leap leap(const PeriodMap *map, const Moment *moment, double longest, Budget *budget, Moment *after) {
    SlowPath path = {
        .manifold = {map, budget, 1, max_transient(map), 0},
        .psi = moment->psi,
        .varies = fabs(map->drift) * longest > NO_DRIFT || is_ramped(&map->system.plant),
        .here = {.velocity = slow_velocity(&map->system, &moment->state, moment->theta), .moment = *moment},
    };
    Manifold *manifold = &path.manifold;
    PathPoint *here = &path.here;
    Leap done = {.outcome = NO_GAIN, .periods = DIFFERENCES};
    double error = moment->leap_error;
    *after = *moment;
    if (path.varies && periods_in_beat(map, 0.0) < SHORTEST_STEP) {
        return (Leap){.outcome = NO_GAIN};
    }
    bool found = slow_rates(manifold, 0.0, &here->moment, &here->after, &here->rates);
    if (!found && isinf(here->rates.offset)) {
        return (Leap){.outcome = NO_GAIN};
    }
    *after = here->after;
    if (!found) {
        done.outcome = NOT_ON_MANIFOLD;
        done.wait = log(here->rates.offset / manifold->allowed) / -log(map->decay);
        return done;
    }
    if (begin_on_manifold(&path)) {
        double travel, passed = take_steps(&path, longest - DIFFERENCES, &travel, &error);
        if (passed > 0.0) {
            land(&path, passed, travel, after);
            after->leap_error = error;
            done.outcome = LEAPT;
            done.periods = passed + DIFFERENCES;
        }
    }
    done.in_vain = (int)fmax(0.0, manifold->maps - done.periods);
    return done;
}
