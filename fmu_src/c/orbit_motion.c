#include "orbit_motion.h"

#include <math.h>
#include <stddef.h>

#include "angle.h"
#include "constants.h"
#include "contact.h"
#include "events.h"
#include "orbit_changes.h"
#include "orbit_error.h"
#include "orbit_price.h"
#include "orbit_ride.h"
#include "orbit_swing.h"
#include "refusal_texts.h"
#include "resolved_start.h"
#include "slow_motion_error.h"
#include "slow_pass.h"

/* Error per step of the slow motion, relative to the fast velocity. */
#define TOLERANCE 3e-10

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

/* Drive phase [rad] over all turns of the orbit in which the normal phase `chi` [rad] fits the lead. */
static double orbit_theta(const OrbitRide *ride, double t, double theta, double chi) {
    double best = INFINITY, phase = theta, lead = ride_lead(ride, t);
    for (int turn = 0; turn < ride->slow.turns; turn++) {
        double there = theta + TAU * turn;
        double miss = fabs(remainder(chi - lead - ride->slow.waves * there, TAU));
        if (miss < best) {
            best = miss;
            phase = there;
        }
    }
    return phase;
}

void orbit_motion_settle(const Law *law, Moment *moment) {
    OrbitState *orbit = &moment->orbit;
    if (orbit->open.kind == NOTHING_OPEN) {
        return;
    }
    OrbitRide ride;
    ride_begin(&ride, law, moment, orbit->lead);
    double chi = law->inputs.phase + moment->psi;
    error_settle(&ride, orbit_theta(&ride, 0.0, moment->theta, chi), orbit);
}

/* Resolve the motion for a drive angle [rad] at least. */
static void resolve_for(const Law *law, Moment *now, double angle) {
    OrbitState *orbit = &now->orbit;
    if (orbit->stage != RESOLVED) {
        orbit_motion_settle(law, now);
        error_leave(law, orbit);
        orbit->stage = RESOLVED;
        orbit->to_go = orbit->waited = 0.0;
    }
    orbit->to_go = fmax(orbit->to_go, angle);
}

/* Whether an orbit of the ride is unknown; motion is then to be resolved. */
static bool is_lost(const Law *law, const OrbitRide *ride, Moment *now) {
    if (ride->unknown > 0.0) {
        resolve_for(law, now, ride->unknown);
        return true;
    }
    return false;
}

/* Go over to the orbit whose W and centre are those of a moment; tells the orbit. Where it is unknown, motion is
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
    double theta = orbit_theta(&ride, 0.0, now->theta, law->inputs.phase + now->psi);
    double momentum = momentum_velocity(map, &now->state, now->theta), velocity = momentum;
    bool settled = false;
    for (int i = 0; i < MAX_TAKING && !settled; i++) {
        if (!ride_moment(&ride, 0.0, theta, velocity, 0.0, &there, point)) {
            return false;
        }
        if (is_lost(law, &ride, now)) {
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

/* Resolve the motion for as long as it has to be and up to `duration` [s]; gives the time that took. */
static bool resolve(const Law *law, double duration, EventSearch *search, Budget *budget,
                    Moment *now, double *time, Refusal *refusal) {
    double w = law->device.drive_frequency;
    bool ends = now->orbit.to_go <= w * duration + NOTHING;
    OrbitPoint point;
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
    return !ends || take_over(law, now, &point) || refuse_infinite_motion(refusal, duration);
}

/* Positions [m] at the ends of periods within a ride. */
typedef struct {
    double time[2], travel[2];
} Marks;

static double travel_at_mark(const void *motion, double t) {
    const Marks *marks = motion;
    return fabs(t - marks->time[0]) < fabs(t - marks->time[1]) ? marks->travel[0] : marks->travel[1];
}

/* Go along orbits for `duration` [s], the last part of a step. Where one on the way is unknown, `now` stays as it is,
 * to be resolved. */
static bool follow(const Law *law, double duration, Budget *budget, Moment *now,
                   Refusal *refusal) {
    OrbitRide ride, *rider = &ride;
    OrbitState *orbit = &now->orbit;
    ride_begin(&ride, law, now, orbit->lead);
    ride_within(&ride, duration);
    const Plant *plant = &law->held.plant;
    double w = plant->drive_frequency, length = TAU / w;
    double share = device_mass_fraction(&law->device);
    double chi = law->inputs.phase + now->psi, start = now->position, centre = orbit->centre;
    double full = friction_share(law) * plant->total_mass * w * law->fast.velocity;
    double highest_load =
        fmax(fabs(plant->load), fabs(plant->load + plant->load_rate * duration));
    SlowPass plan = {
        .acceleration = ride_acceleration,
        .to_kink = ride_to_kink,
        .motion = &rider,
        .fast = law->fast.velocity,
        .tolerance = TOLERANCE * law->fast.velocity,
        .step = slow_pass_step(law->fast.velocity, plant->total_mass, full + highest_load, duration),
        .beat = slow_phase_beat(&ride.slow),
        .may_settle = !slow_phase_drifts(&ride.slow) && plant->load_rate == 0.0 &&
                      ride.source != FROM_SEARCH,
        .most = MAX_SLOW_STEPS,
        .jerk = -plant->load_rate / plant->total_mass,
        .sway = slow_friction_sway(&ride.first) / plant->total_mass,
    };
    ride_edges(&ride, plan.edge, &plan.margin);
    error_open(orbit_theta(&ride, 0.0, now->theta, chi), orbit);
    Reached reached = {.velocity = orbit->velocity, .step = plan.step};
    double last = period_last_end(now->theta, w, duration);
    Marks marks = {{last - length, last}, {0.0, 0.0}};
    OrbitPoint point;
    Moment there;
    for (int i = 0; i < 2; i++) {
        if (!(marks.time[i] > 0.0 && marks.time[i] < duration)) {
            continue;
        }
        double step = reached.step;
        if (!slow_pass(&plan, marks.time[i], budget, &reached, refusal)) {
            return false;
        }
        if (is_lost(law, &ride, now)) {
            return true;
        }
        reached.step = fmax(reached.step, step);
        double theta = orbit_theta(&ride, reached.t, 0.0, chi + turned_by(plant, reached.t));
        if (!ride_moment(&ride, reached.t, theta, reached.velocity, centre + reached.moved, &there,
                         &point)) {
            return refuse_infinite_motion(refusal, duration);
        }
        Response swing = swing_after(law, &orbit->swing, reached.t);
        add_swing(&there, &swing, share);
        marks.travel[i] = there.position - start;
    }
    if (!slow_pass(&plan, duration, budget, &reached, refusal)) {
        return false;
    }
    if (is_lost(law, &ride, now)) {
        return true;
    }
    double theta = within_turn(now->theta + w * duration);
    double there_theta = orbit_theta(&ride, duration, theta, chi + turned_by(plant, duration));
    if (!ride_moment(&ride, duration, there_theta, reached.velocity, centre + reached.moved, &there,
                     &point)) {
        return refuse_infinite_motion(refusal, duration);
    }
    if (is_lost(law, &ride, now)) {
        return true;
    }
    Response swing = swing_after(law, &orbit->swing, duration);
    add_swing(&there, &swing, share);
    Segment segment = {duration, there.position - start, there.state.velocity, false,
                       travel_at_mark, &marks};
    now->theta = period_advance(&now->means, &segment, now->theta, w);
    now->psi = within_turn(now->psi + turned_by(plant, duration));
    now->position = there.position;
    now->state = there.state;
    now->bristle = there.bristle;
    now->stops = there.stops;
    now->mode = there.mode;
    now->event_age = INFINITY;
    orbit->velocity = reached.velocity;
    orbit->centre = centre + reached.moved;
    orbit->swing = swing;
    error_follow(&ride, &point, there_theta, duration, orbit);
    orbit->lead = ride_lead(&ride, duration);
    if (slow_phase_drifts(&ride.slow)) {
        orbit->waited += w * duration;
        if (orbit_is_due(law, orbit)) {
            orbit_pay(law, orbit, orbit->lead);
        }
        orbit->lead = within_turn(orbit->lead);
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
        if (!follow(&later, left, budget, after, refusal)) {
            return false;
        }
        if (after->orbit.stage == ON_ORBIT) {
            return true;
        }
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
        return fabs(orbit->ahead) + orbit->doubt + orbit->unrest + resolution_error(law);
    }
    OrbitRide ride;
    ride_begin(&ride, law, moment, orbit->lead);
    double chi = law->inputs.phase + moment->psi;
    double theta = orbit_theta(&ride, 0.0, moment->theta, chi);
    return error_at(&ride, theta, orbit);
}

double orbit_motion_error(const Law *law, const Moment *moment) {
    double loading = loading_error(law, moment->orbit.loading);
    return fmin(standing_error(law, moment) + loading, law->fast.velocity);
}
