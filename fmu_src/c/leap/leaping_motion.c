/* Motion that leaps over periods: fidelity 0, averages of second order.
 *
 * Resolved to the next section, over a whole number of periods in a leap, resolved again for the last periods: outputs,
 * events and state are those of resolved motion. Where leaping gains nothing or does not hold, motion stays
 * resolved. */
#include <stddef.h>

#include "../base/clock.h"
#include "../resolved/motion.h"
#include "leap.h"

/* A load whose waves in q turns, at most MAX_TURNS_OF_PERIOD, are off an integer by at most NEAR_REPEATING / q counts
 * as one that repeats. Leaps need less: a drift below an eighth of a beat in their shortest step, 0.0035 waves. */
enum { MAX_TURNS_OF_PERIOD = 4 };
#define NEAR_REPEATING 0.03

/* Fewest periods that may be left for a leap. */
#define SHORTEST_LEAP 64.0

/* Periods that are resolved after an attempt to leap that mapped one period in vain: attempts cost an eighth of
 * resolved motion at most. */
#define PAUSE 8.0

/* Fewest periods that are resolved while a transient decays, and number of attempts for which it is waited so. Fast
 * states that are still off the manifold then do not follow the slow motion. */
#define MIN_WAIT 8.0
enum { MAX_WAITS = 2 };

/* Fewest periods that are resolved after the first attempt in vain; twice as many after the second, and so on. */
#define MIN_PAUSE 32.0

/* Factor of the tolerance of LuGre friction where a leap is to follow: what resolved motion errs by stays in the slow
 * velocity, and adds up over many periods to several tolerances. */
#define TIGHT 0.1

/* How far a step is: the present moment, and the time left [s]. It began `passed` [s] after the step. */
typedef struct {
    const System *system;
    Budget *budget;
    double passed;
    Clock clock;
    double left;
    Moment now;
} Progress;

/* Resolve the motion for `duration` [s]; `tight` where a leap is to follow. */
static bool resolve(Progress *progress, double duration, bool tight, Refusal *refusal) {
    Moment before = progress->now;
    System system = system_after(progress->system, progress->clock.elapsed);
    system.device.tolerance *= tight ? TIGHT : 1.0;
    progress->budget->passed = progress->passed + progress->clock.elapsed;
    if (!events_advance(&system, &before, duration, NULL, NULL, progress->budget, &progress->now, refusal)) {
        return false;
    }
    progress->left = duration == progress->left ? 0.0 : clock_advance(&progress->clock, duration);
    return true;
}

/* Resolve the motion for `periods`, and on to the next section. */
static bool resolve_to_section(Progress *progress, const PeriodMap *map, double periods, bool tight, Refusal *refusal) {
    double w = progress->system->plant.drive_frequency;
    double to_section = within_turn(map->section - progress->now.theta) / w;
    double duration = periods * map->period + to_section;
    if (duration > 0.0 && !resolve(progress, duration, tight, refusal)) {
        return false;
    }
    progress->now.theta = map->section;
    return true;
}

/* Periods to be resolved after an attempt to leap, the `attempts`-th since the last leap. */
static double pause_after(const Leap *leap, int attempts) {
    bool waits = leap->outcome == NOT_ON_MANIFOLD && attempts <= MAX_WAITS;
    double least = waits ? fmax(MIN_WAIT, ceil(leap->wait)) : attempts * MIN_PAUSE;
    return fmax(least, PAUSE * leap->in_vain);
}

/* The period map under the inputs of now. */
static bool prepare_map(const Progress *progress, PeriodMap *map) {
    System system = system_after(progress->system, progress->clock.elapsed);
    return period_map_prepare(map, &system, turns_of_period(&system, MAX_TURNS_OF_PERIOD, NEAR_REPEATING));
}

/* Advance the motion:
 *
 * 1. resolve to the section, after a pause where the last attempt to leap asked for one;
 * 2. leap over as many periods as are left, or as far as that gains;
 * 3. repeat while enough periods are left;
 * 4. resolve the rest. */
static bool leaping_advance(const System *system, const Moment *moment, double duration, EventSearch *search,
                            Budget *budget, Moment *after, Refusal *refusal) {
    (void)search;
    Progress progress = {system, budget, budget->passed, clock_of(duration), duration, *moment};
    double turn = TAU / system->plant.drive_frequency, pause = 0.0;
    int attempts = 0;
    PeriodMap map;
    bool gains = true;
    bool leaps = progress.left > SHORTEST_LEAP * turn && prepare_map(&progress, &map);
    while (leaps && progress.left > (SHORTEST_LEAP + pause) * map.period) {
        if (!resolve_to_section(&progress, &map, pause, gains, refusal)) {
            return false;
        }
        if (is_ramped(&system->plant) && !prepare_map(&progress, &map)) {
            break;
        }
        Moment before = progress.now;
        Leap done = leap(&map, &before, floor(progress.left / map.period), budget, &progress.now);
        progress.left = clock_advance(&progress.clock, done.periods * map.period);
        attempts = done.outcome == LEAPT ? 0 : attempts + 1;
        pause = pause_after(&done, attempts);
        gains = done.outcome != NO_GAIN;
    }
    if (progress.left > 0.0 && !resolve(&progress, progress.left, false, refusal)) {
        return false;
    }
    *after = progress.now;
    return true;
}

const Motion LEAPING_MOTION = {
    .start = resolved_start,
    .advance = leaping_advance,
    .mode = resolved_mode,
    .force = resolved_force,
    .power = resolved_power,
    .rates = resolved_rates,
    .error = resolved_error,
};
