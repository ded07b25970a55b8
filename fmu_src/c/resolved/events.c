#include "events.h"

#include <stddef.h>

#include "../base/clock.h"
#include "../base/constants.h"
#include "../friction/segment.h"

/* Drive periods before the end of a motion from which it counts in means: they are those of the last whole one, and the
 * first that ends is counted in part. */
#define COUNTED 3.0

/* What the work of a motion is called where it is refused. */
static const char *const SEGMENTS = "segments of motion";

/* Ends a search with the event at the time of the clock, unless the search ignores that time. */
static bool record_event(EventSearch *search, const Clock *clock) {
    if (search == NULL || !(clock->elapsed > search->after)) {
        return false;
    }
    search->found = true;
    search->elapsed = clock->elapsed;
    search->carry = clock->carry;
    return true;
}

/* Whether the slider reversed at the moment `begin`, where the finished segment began; `now` then goes back to that
 * moment. Only the segment after a stop shows whether the stop was a reversal. A slider that sets out from rest at the
 * start of the search does not reverse. */
static bool found_reversal(EventSearch *search, const Clock *clock, const Segment *segment, const Moment *begin,
                           Moment *now) {
    bool turns = segment->changes_direction && begin->state.velocity == 0.0 && begin->event_age != 0.0;
    bool moved = clock->elapsed > 0.0 || begin->sliding == -segment->direction;
    if (!turns || !moved || !record_event(search, clock)) {
        return false;
    }
    *now = *begin;
    now->event_age = 0.0;
    return true;
}

/* Makes the end of a motion an event if it is one within rounding, or if it is a stop: no further segment follows that
 * would show whether the stop is a reversal. */
static void end_at_event(const Segment *segment, const System *system, Moment *now) {
    if (segment->direction * now->state.velocity < 0.0) {
        now->state.velocity = 0.0;
    }
    moment_enter(now, system->friction->mode(system, now));
    if (segment_stopped(segment) && now->mode != segment->mode) {
        now->event_age = 0.0;
    }
}

/* Time [s] until the normal frequency changes its sign; infinite if it never does. */
static double time_to_turn(const Plant *plant) {
    if (plant->normal_rate == 0.0) {
        return INFINITY;
    }
    double t = -plant->normal_frequency / plant->normal_rate;
    return t > 0.0 ? t : INFINITY;
}

/* Add a contact mode to an itinerary, unless it is the last one. */
static void pass_mode(Itinerary *itinerary, int mode) {
    if (mode != itinerary->last) {
        itinerary->hash = (itinerary->hash ^ (uint64_t)(mode + 2)) * UINT64_C(0x100000001b3);
        itinerary->last = mode;
    }
}

/* In this order: refuse a motion of too much work, and enter the contact mode of the start. Then segment by segment:
 * find how long the segment may last, until the contact lifts or touches down, the arc ends or the normal frequency
 * changes sign; let the friction law begin it; follow it, up to a stop or a release; move to its end; let the inputs
 * grow; change to the next contact mode. A search ends the motion at the first event. */
bool events_advance(const System *start, const Moment *moment, double duration, EventSearch *search,
                    Itinerary *itinerary, Budget *budget, Moment *now, Refusal *refusal) {
    bool inputs_grow = is_ramped(&start->plant);
    System grown;
    const System *system = start;
    if (inputs_grow) {
        grown = *start;
        system = &grown;
    }
    const FrictionLaw *friction = system->friction;
    const Plant *plant = &system->plant;
    double remaining = duration;
    double counted = COUNTED * TAU / plant->drive_frequency;
    Clock clock = clock_of(duration);
    int count = 0, max_count = budget_left(budget, MAX_STEP_SEGMENTS);
    Segment segment;
    Moment begin;
    /* Segments of the maximum length may be too many already. A search may end before these are over. */
    if (search == NULL && duration > max_count * system->arc) {
        return budget_refuse(budget, max_count * system->arc, MAX_STEP_SEGMENTS, SEGMENTS, refusal);
    }
    *now = *moment;
    segment.phasors.known = false;
    segment.from_rest = now->state.velocity == 0.0;
    moment_enter(now, friction->mode(system, now));
    while (remaining > 0.0 && isfinite(now->state.velocity)) {
        if (++count > max_count) {
            return budget_refuse(budget, clock.elapsed, MAX_STEP_SEGMENTS, SEGMENTS, refusal);
        }
        double switching = time_to_switch(plant, now->psi, now->mode == LIFTED);
        double turning = time_to_turn(plant);
        double longest = fmin(fmin(fmin(remaining, switching), system->arc), turning);
        if (search != NULL) {
            begin = *now;
        }
        segment.counts_means = (search != NULL || remaining - fmin(remaining, system->arc) <= counted) &&
                               (itinerary == NULL || itinerary->counts_means);
        friction->begin(&segment, system, now, longest);
        segment_follow(&segment, plant, now, longest);
        if (itinerary != NULL) {
            pass_mode(itinerary, segment.mode == LIFTED ? LIFTED : segment.direction);
        }
        segment_finish(&segment, plant, now);
        if (inputs_grow) {
            grown = system_after(start, clock.elapsed + segment.t);
            if (segment.t == turning) {
                grown.plant.normal_frequency = 0.0;
            }
        }
        if (search != NULL && found_reversal(search, &clock, &segment, &begin, now)) {
            break;
        }
        friction->enter_next_mode(&segment, system, now, segment.zero_of < 0 && segment.t == switching);
        remaining = segment.t == remaining ? 0.0 : clock_advance(&clock, segment.t);
        if (search != NULL && !(remaining > 0.0)) {
            clock = (Clock){duration, duration, 0.0};
            end_at_event(&segment, system, now);
        }
        if (now->event_age == 0.0 && record_event(search, &clock)) {
            break;
        }
    }
    budget_spend(budget, count, MAX_STEP_SEGMENTS);
    return true;
}
