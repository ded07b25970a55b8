#include "orbit_motion.h"

#include <math.h>
#include <stddef.h>

#include "angle.h"
#include "constants.h"
#include "contact.h"
#include "events.h"
#include "orbit_bend.h"
#include "orbit_changes.h"
#include "orbit_error.h"
#include "orbit_follow.h"
#include "orbit_price.h"
#include "orbit_ride.h"
#include "refusal_texts.h"
#include "resolved_start.h"
#include "slow_motion_error.h"

/* Change of the slow velocity at which it belongs to W, over the fast velocity; iterations. */
#define TAKEN 1e-14
enum { MAX_TAKING = 40 };

/* Drive angle [rad] that is not worth a step of its own. */
#define NOTHING 1e-9

/* Largest decay of the slow motion in a turn over that of the resonator. */
#define SEPARATION 1.0

bool has_slow_motion(const Law *law) {
    if (!(law->fast.velocity > 0.0) || orbit_phase_of(law).turns == 0) {
        return false;
    }
    double slow = slow_decay_in_turn(law);
    return slow > 0.0 && slow < SEPARATION * decay_in_turn(law) && slow < 1.0 && resolved_is_bounded(law);
}

OrbitState orbit_motion_start(const Law *law, const Moment *first) {
    return (OrbitState){
        .stage = RESOLVED, .to_go = resolved_angle(law, first), .under = orbit_values_of(law)};
}

/* The lead [rad] at drive phase 0 of the turn in which it is least, rounded. */
static double lead_of(const Law *law, const Moment *moment) {
    const SlowPhase slow = orbit_phase_of(law);
    double least = INFINITY, chi = law->inputs.phase + moment->psi;
    if (law->device.normal_amplitude == 0.0) {
        return 0.0;
    }
    for (int turn = 0; turn < slow.turns; turn++) {
        double past = slow.waves * (moment->theta + TAU * turn);
        double lead = rounded_lead(remainder(chi - past, TAU));
        least = fmin(least, lead < 0.0 ? lead + TAU : lead);
    }
    return least;
}

void orbit_motion_settle(const Law *law, Moment *moment) {
    OrbitState *orbit = &moment->orbit;
    if (orbit->open.kind == NOTHING_OPEN) {
        return;
    }
    OrbitRide ride;
    ride_begin(&ride, law, moment, orbit->lead);
    double chi = law->inputs.phase + moment->psi;
    error_settle(&ride, ride_theta(&ride, 0.0, moment->theta, chi), orbit);
}

/* Resolve the motion for a drive angle [rad] at least. */
static void resolve_for(const Law *law, Moment *now, double angle) {
    OrbitState *orbit = &now->orbit;
    if (orbit->stage != RESOLVED) {
        if (is_without_error(orbit)) {
            orbit->open = (OpenError){.kind = NOTHING_OPEN};
        } else {
            orbit_motion_settle(law, now);
            error_leave(law, orbit);
        }
        orbit->stage = RESOLVED;
        orbit->to_go = orbit->waited = 0.0;
    }
    orbit->to_go = fmax(orbit->to_go, angle);
}

/* Go over to the orbit whose W and centre are those of a moment; gives the orbit. Where it is unknown, motion is
 * resolved on. */
static bool take_over(const Law *law, Moment *now, OrbitPoint *point) {
    OrbitState *orbit = &now->orbit;
    OrbitRide ride;
    Moment there;
    orbit->lead = lead_of(law, now);
    orbit_visit(&orbit->leads, orbit->lead);
    if (orbit_is_due(law, orbit)) {
        orbit_pay(law, orbit, orbit->lead);
    }
    ride_begin(&ride, law, now, orbit->lead);
    const PeriodMap *map = ride.map;
    double share = map->law.held.plant.mass_fraction;
    double theta = ride_theta(&ride, 0.0, now->theta, law->inputs.phase + now->psi);
    double momentum = momentum_velocity(map, &now->state, now->theta), velocity = momentum;
    bool settled = false;
    for (int i = 0; i < MAX_TAKING && !settled; i++) {
        if (!ride_moment(&ride, 0.0, theta, velocity, 0.0, &there, point)) {
            return false;
        }
        if (ride.unknown > 0.0) {
            resolve_for(law, now, ride.unknown);
            point->of[ORBIT_FACTOR] = 1.0;
            return true;
        }
        double next = velocity + momentum - momentum_velocity(map, &there.state, theta);
        settled = fabs(next - velocity) <= TAKEN * map->speed;
        velocity = next;
    }
    double apart = now->state.displacement - there.state.displacement;
    double centre = now->position + share * apart;
    if (orbit->stage == ON_ORBIT) {
        orbit->swing = (Response){apart, now->state.rate - there.state.rate};
        error_jump(law, orbit);
    } else {
        /* What is apart after resolved motion is how far it lags behind the orbit: it stays. */
        orbit->swing = (Response){0.0, 0.0};
        error_begin(&ride, point, velocity, theta, now, orbit);
        now->position = centre;
    }
    orbit->stage = ON_ORBIT;
    orbit->to_go = orbit->waited = 0.0;
    orbit->velocity = velocity;
    orbit->centre = centre - there.position;
    return true;
}

/* A drive angle [rad] of resolved motion is over. */
static void resolved_for(const Law *law, OrbitState *orbit, double angle) {
    error_calm(law, angle, orbit);
    orbit->to_go = fmax(0.0, orbit->to_go - angle);
    orbit->waited += angle;
}

/* Follow changes since the last step: to other orbits, or by resolved motion. */
static bool adapt(const Law *law, Moment *now) {
    OrbitState *orbit = &now->orbit;
    OrbitPoint point;
    const OrbitChanges changes = orbit_note_changes(law, orbit);
    bool anew = changes.tuned || changes.led;
    bool changed = changes.shaken || anew || changes.turned;
    bool starts = orbit->stage == RESOLVED && orbit->waited == 0.0;
    if (changes.shaken) {
        resolve_for(law, now, resolved_angle(law, now));
    }
    bool resolved = orbit->stage == RESOLVED;
    if (resolved ? starts || !changed : !(changed || changes.loaded || changes.drifts)) {
        return true;
    }
    double lead = anew || resolved ? lead_of(law, now) : orbit->lead;
    double price = orbit_price(law, orbit, lead, changed);
    if (resolved) {
        resolve_for(law, now, price - orbit->waited);
        return true;
    }
    if (price > 0.0) {
        resolve_for(law, now, price);
        orbit_pay(law, orbit, lead);
        return true;
    }
    if (anew) {
        if (!take_over(law, now, &point)) {
            return false;
        }
    } else if (changes.loaded && law->device.friction_law != 0) {
        OrbitRide ride;
        ride_begin(&ride, law, now, orbit->lead);
        point = ride_point(&ride, 0.0, orbit->velocity);
    } else {
        return true;
    }
    double lag = lag_angle(law, point.of[ORBIT_FACTOR] - 1.0);
    if (lag > 0.0) {
        resolve_for(law, now, lag);
    }
    return true;
}

/* Resolve the `left` [s] of a step `passed` [s] after its beginning, where orbits are unknown. */
static bool resolve_rest(const Law *law, double passed, double left, EventSearch *search,
                         Budget *budget, Moment *now, Refusal *refusal) {
    double w = law->device.drive_frequency;
    Law full = law_after(law->resolved, passed);
    Moment before = *now;
    OrbitState orbit = now->orbit;
    if (search != NULL) {
        search->after -= passed;
    }
    if (!events_advance(&full, &before, left, search, budget, now, refusal)) {
        return false;
    }
    now->orbit = orbit;
    bool early = search != NULL && search->found;
    resolved_for(law, &now->orbit, w * (early ? search->elapsed : left));
    if (search != NULL) {
        search->after += passed;
        search->elapsed += early ? passed : 0.0;
    }
    return true;
}

/* Resolve the motion on for as long as the bend of the bristle asks for, `time` [s] after the beginning of a step of
 * `duration` [s] and up to its end, then go over to orbits. */
static bool end_resolved(const Law *law, double duration, EventSearch *search, Budget *budget,
                         Moment *now, double *time, Refusal *refusal) {
    OrbitState *orbit = &now->orbit;
    double w = law->device.drive_frequency, decay;
    OrbitPoint point;
    while (true) {
        decay = orbit_bend_decay(law, lead_of(law, now), now);
        double to_go = bend_angle(decay) - orbit->waited, left = fmin(to_go / w, duration - *time);
        if (!(to_go > NOTHING)) {
            break;
        }
        orbit->to_go = to_go;
        if (!(left * w > NOTHING)) {
            return true;
        }
        if (!resolve_rest(law, *time, left, search, budget, now, refusal)) {
            return false;
        }
        *time += left;
        if (search != NULL && search->found) {
            return true;
        }
    }
    double bend = velocity_of_bend(law, decay, orbit->waited);
    if (!take_over(law, now, &point)) {
        return refuse_infinite_motion(refusal, duration);
    }
    orbit->doubt += orbit->stage == ON_ORBIT ? bend : 0.0;
    return true;
}

/* Resolve the motion for as long as it has to be and up to `duration` [s]; gives the time that took. */
static bool resolve(const Law *law, double duration, EventSearch *search, Budget *budget,
                    Moment *now, double *time, Refusal *refusal) {
    double w = law->device.drive_frequency;
    bool ends = now->orbit.to_go <= w * duration + NOTHING;
    *time = ends ? fmin(now->orbit.to_go / w, duration) : duration;
    if (*time * w > NOTHING || !ends) {
        Moment after;
        if (!events_advance(law->resolved, now, *time, search, budget, &after, refusal)) {
            return false;
        }
        *now = after;
        if (search != NULL && search->found) {
            resolved_for(law, &now->orbit, w * search->elapsed);
            return true;
        }
        resolved_for(law, &now->orbit, w * *time);
    } else {
        *time = 0.0;
    }
    return !ends || end_resolved(law, duration, search, budget, now, time, refusal);
}

bool orbit_motion_advance(const Law *law, const Moment *moment, double duration,
                          EventSearch *search, Budget *budget, Moment *after, Refusal *refusal) {
    double resolved = 0.0, w = law->device.drive_frequency;
    *after = *moment;
    if (!adapt(law, after)) {
        return refuse_infinite_motion(refusal, duration);
    }
    if (after->orbit.stage == RESOLVED && !resolve(law, duration, search, budget, after, &resolved, refusal)) {
        return false;
    }
    double left = resolved < duration ? duration - resolved : 0.0;
    if ((search != NULL && search->found) || !(left * w > 0.0)) {
        return true;
    }
    if (after->orbit.stage == ON_ORBIT) {
        Law later = is_ramped(&law->held.plant) ? law_after(law, resolved) : *law;
        OrbitRide ride;
        bool followed;
        ride_begin(&ride, &later, after, after->orbit.lead);
        ride_within(&ride, left);
        if (!orbit_follow(&later, &ride, left, budget, after, &followed, refusal)) {
            return false;
        }
        if (followed) {
            return true;
        }
        resolve_for(&later, after, ride.unknown);
    }
    return resolve_rest(law, resolved, left, search, budget, after, refusal);
}

/* The estimate under held inputs. */
static double standing_error(const Law *law, const Moment *moment) {
    const OrbitState *orbit = &moment->orbit;
    if (orbit->stage == AVERAGED) {
        return first_order_error(law);
    }
    if (orbit->stage != ON_ORBIT) {
        return fabs(orbit->ahead) + orbit->doubt + orbit->unrest +
               resolved_error(law, orbit->waited);
    }
    OrbitRide ride;
    ride_begin(&ride, law, moment, orbit->lead);
    double chi = law->inputs.phase + moment->psi;
    double theta = ride_theta(&ride, 0.0, moment->theta, chi);
    return error_at(&ride, theta, orbit);
}

double orbit_motion_error(const Law *law, const Moment *moment) {
    double loading = loading_error(law, moment->orbit.loading);
    return fmin(standing_error(law, moment) + loading, law->fast.velocity);
}
