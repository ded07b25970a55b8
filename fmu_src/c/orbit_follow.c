#include "orbit_follow.h"

#include <math.h>

#include "angle.h"
#include "constants.h"
#include "orbit_error.h"
#include "orbit_price.h"
#include "orbit_swing.h"
#include "refusal_texts.h"
#include "settling.h"
#include "slow_motion_error.h"
#include "slow_pass.h"

/* Error per step of the slow motion, relative to the fast velocity. */
#define TOLERANCE 3e-10

/* Rounding error of an acceleration, in units of the last place of that by all friction and load. */
#define ROUNDING 8.0

/* Positions [m] at the ends of periods within a ride. */
typedef struct {
    double time[2], travel[2];
} Marks;

/* The slow motion: it is `settled` where its velocity stays as it is. */
typedef struct {
    SlowPass plan;
    bool settled;
    Reached reached;
} SlowRide;

/* A slow velocity [m/s] at a drive phase [rad] over all turns, and how far ahead of its slow centre [m] the
 * slider is there. */
typedef struct {
    double velocity, theta, ahead;
} RidePlace;

/* Begin at a slow velocity [m/s]; `rider` points to a pointer to the ride. */
static void slow_ride_begin(SlowRide *slow, OrbitRide *const *rider, double velocity, double duration) {
    const OrbitRide *ride = *rider;
    const Law *law = ride->law;
    const Plant *plant = &law->held.plant;
    SlowPass *plan = &slow->plan;
    double fast = law->fast.velocity, mass = plant->total_mass;
    double full = friction_share(law) * mass * plant->drive_frequency * fast;
    double last_load = plant->load + plant->load_rate * duration;
    double strongest = full + fmax(fabs(plant->load), fabs(last_load));
    *plan = (SlowPass){
        .acceleration = ride_acceleration,
        .to_kink = ride_to_kink,
        .motion = rider,
        .fast = fast,
        .tolerance = TOLERANCE * fast,
        .step = slow_pass_step(fast, mass, strongest, duration),
        .beat = slow_phase_beat(&ride->slow),
        .may_settle = !slow_phase_drifts(&ride->slow) && plant->load_rate == 0.0 &&
                      ride->source != FROM_SEARCH,
        .max_steps = MAX_SLOW_STEPS,
        .jerk = -plant->load_rate / mass,
        .sway = slow_friction_sway(&ride->first) / mass,
    };
    ride_edges(ride, plan->edge, &plan->margin);
    slow->reached = (Reached){.velocity = velocity, .step = plan->step};
    slow->settled = plan->may_settle && is_settled(ride_acceleration, rider, fast,
                                                   ROUNDING * EPSILON * strongest / mass, &slow->reached);
}

/* Follow the slow motion up to time `end` [s]. */
static bool slow_ride(SlowRide *slow, double end, Budget *budget, Refusal *refusal) {
    Reached *now = &slow->reached;
    if (!slow->settled) {
        return slow_pass(&slow->plan, end, budget, now, refusal);
    }
    now->moved += now->velocity * (end - now->t);
    now->t = end;
    return true;
}

static double travel_at_mark(const void *motion, double t) {
    const Marks *marks = motion;
    return fabs(t - marks->time[0]) < fabs(t - marks->time[1]) ? marks->travel[0] : marks->travel[1];
}

bool orbit_follow(const Law *law, OrbitRide *ride, double duration, Budget *budget, Moment *now,
                  bool *followed, Refusal *refusal) {
    OrbitState *orbit = &now->orbit;
    *followed = false;
    const Plant *plant = &law->held.plant;
    double w = plant->drive_frequency, length = TAU / w;
    double share = device_mass_fraction(&law->device);
    double chi = law->inputs.phase + now->psi, start = now->position, centre = orbit->centre;
    SlowRide slow;
    const Reached *reached = &slow.reached;
    slow_ride_begin(&slow, &ride, orbit->velocity, duration);
    error_open(ride_theta(ride, 0.0, now->theta, chi), orbit);
    double last = period_last_end(now->theta, w, duration);
    Marks marks = {{last - length, last}, {0.0, 0.0}};
    RidePlace place = {NAN, 0.0, 0.0};
    OrbitPoint point;
    Moment there;
    for (int i = 0; i < 2; i++) {
        if (!(marks.time[i] > 0.0 && marks.time[i] < duration)) {
            continue;
        }
        double step = reached->step;
        if (!slow_ride(&slow, marks.time[i], budget, refusal)) {
            return false;
        }
        if (ride->unknown > 0.0) {
            return true;
        }
        slow.reached.step = fmax(reached->step, step);
        double theta = ride_theta(ride, reached->t, 0.0, chi + turned_by(plant, reached->t));
        bool same = slow.settled && reached->velocity == place.velocity && theta == place.theta;
        if (!same) {
            if (!ride_moment(ride, reached->t, theta, reached->velocity, 0.0, &there, &point)) {
                return refuse_infinite_motion(refusal, duration);
            }
            place = (RidePlace){reached->velocity, theta, there.position};
        }
        Response swing = swing_after(law, &orbit->swing, reached->t);
        double ahead = place.ahead - share * swing.displacement;
        marks.travel[i] = centre + reached->moved + ahead - start;
    }
    if (!slow_ride(&slow, duration, budget, refusal)) {
        return false;
    }
    if (ride->unknown > 0.0) {
        return true;
    }
    double theta = within_turn(now->theta + w * duration);
    double there_theta = ride_theta(ride, duration, theta, chi + turned_by(plant, duration));
    if (!ride_moment(ride, duration, there_theta, reached->velocity, centre + reached->moved, &there,
                     &point)) {
        return refuse_infinite_motion(refusal, duration);
    }
    if (ride->unknown > 0.0) {
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
    orbit->velocity = reached->velocity;
    orbit->centre = centre + reached->moved;
    orbit->swing = swing;
    error_follow(ride, &point, there_theta, duration, orbit);
    orbit->lead = ride_lead(ride, duration);
    if (slow_phase_drifts(&ride->slow)) {
        orbit->waited += w * duration;
        if (orbit_is_due(law, orbit)) {
            orbit_pay(law, orbit, orbit->lead);
        }
        orbit->lead = within_turn(orbit->lead);
    }
    *followed = true;
    return true;
}
