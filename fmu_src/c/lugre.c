#include "lugre.h"

#include <math.h>

#include "angle.h"
#include "clock.h"
#include "coulomb.h"
#include "first_zero.h"
#include "slide.h"
#include "taylor_slide.h"

/* Part of the tolerance that one series may use up, and that the bend of the bristle may still be
 * away from full when closed forms take over. */
#define SHARE 0.01

/* Series and closed forms, for each turn of the fastest oscillation, up to which work is accepted:
 * several times what presliding on the hardest bristles takes. */
enum { MOST_LEGS = 20000 };

/* A motion in one direction, and how far it may be followed [s]. */
typedef struct {
    bool bends;
    int direction;
    double reach;
    union {
        Slide slide;
        TaylorSlide series;
    } motion;
} Leg;

/* Velocity [m/s] that tolerances refer to: of drive, friction over a turn, and motion. */
static double velocity_scale(const Plant *plant, const State *state) {
    double w = plant->drive_frequency;
    double forces = plant->friction_preload + plant->friction_amplitude + fabs(plant->load);
    double swing =
        plant->mass_fraction * hypot(state->rate, plant->stick.frequency * state->displacement);
    return complex_abs(plant->drive) / w + forces / (plant->total_mass * w) +
           fabs(state->velocity) + swing;
}

static void leg_begin(Leg *leg, int direction, const Held *held, const Bristle *bristle,
                      bool lifted, const State *state, double bent, double theta, double chi,
                      double tolerance) {
    double unbent = bristle->coefficient - direction * bent;
    leg->direction = direction;
    leg->bends = !lifted && !(fabs(unbent) <= SHARE * tolerance * bristle->coefficient);
    leg->reach = held->arc;
    if (!leg->bends) {
        int sign = lifted ? 0 : direction;
        slide_begin(&leg->motion.slide, held, sign, state, theta, chi, direction);
        return;
    }
    double allowed = SHARE * tolerance * velocity_scale(&held->plant, state);
    TaylorSlide *series = &leg->motion.series;
    taylor_slide_begin(series, &held->plant, bristle, direction, state, bent, theta, chi, allowed);
    leg->reach = fmin(series->reach, held->arc);
}

/* Whether a slider at rest begins to move in this direction, or not at all. */
static bool leg_departs(const Leg *leg) {
    if (leg->bends) {
        return taylor_slide_departs(&leg->motion.series);
    }
    Watch watch = slide_watch(&leg->motion.slide);
    return watch.signal(watch.motion, 0.0).slope >= 0.0;
}

/* The velocity in this direction, up to `horizon` [s]. */
static Watch leg_watch(Leg *leg, double horizon) {
    return leg->bends ? taylor_slide_watch(&leg->motion.series, horizon)
                      : slide_watch(&leg->motion.slide);
}

static double leg_travel(const void *motion, double t) {
    const Leg *leg = motion;
    return leg->bends ? taylor_slide_travel(&leg->motion.series, t)
                      : slide_travel(&leg->motion.slide, t);
}

/* State after `t` [s], and the displacement [m] in `travel`. */
static State leg_end(const Leg *leg, double t, double *travel) {
    if (!leg->bends) {
        return slide_end(&leg->motion.slide, t, travel);
    }
    *travel = taylor_slide_travel(&leg->motion.series, t);
    return taylor_slide_state(&leg->motion.series, t);
}

/* The motion in the direction that the slider has, or at rest takes. */
static void leg_onward(Leg *leg, const Held *held, const Bristle *bristle, bool lifted,
                       const State *state, double bent, double theta, double chi,
                       double tolerance) {
    if (state->velocity == 0.0) {
        leg_begin(leg, FORWARD, held, bristle, lifted, state, bent, theta, chi, tolerance);
        if (leg_departs(leg)) {
            return;
        }
    }
    int direction = state->velocity > 0.0 ? FORWARD : BACKWARD;
    leg_begin(leg, direction, held, bristle, lifted, state, bent, theta, chi, tolerance);
}

Moment lugre_start(const Held *held, const Bristle *bristle, State state, double position,
                   double deflection) {
    Moment moment = {0};
    moment.state = state;
    moment.position = position;
    moment.mode = lugre_mode_of(held, &state, 0.0);
    moment.counts.sliding = moment.mode == LIFTED ? 0 : moment.mode;
    moment.event_age = INFINITY;
    moment.bristle = bristle->stiffness * deflection;
    return moment;
}

int lugre_mode_of(const Held *held, const State *state, double psi) {
    const Plant *plant = &held->plant;
    if (is_lifted(&held->window, psi + plant->phase, plant->normal_frequency)) {
        return LIFTED;
    }
    if (state->velocity == 0.0) {
        return STICK;
    }
    return state->velocity > 0.0 ? FORWARD : BACKWARD;
}

double lugre_friction_force(const Held *held, const Bristle *bristle, const Moment *moment,
                            int mode) {
    if (mode == LIFTED) {
        return 0.0;
    }
    double velocity = moment->state.velocity, bent = moment->bristle;
    double drag = velocity - fabs(velocity) * bent / bristle->coefficient;
    double share = (bent + bristle->damping * drag) / bristle->coefficient;
    return friction_limit(&held->plant, moment->psi) * share;
}

bool lugre_advance(const Held *held, const Bristle *bristle, double tolerance, const Moment *moment,
                   double duration, Moment *after, Refusal *refusal) {
    const Plant *plant = &held->plant;
    double w = plant->drive_frequency, q = plant->normal_frequency;
    Moment now = *moment;
    bool lifted = is_lifted(&held->window, now.psi + plant->phase, q);
    if (lifted != (now.mode == LIFTED)) {
        now.event_age = 0.0;
    }
    Clock clock = clock_of(duration);
    double remaining = duration;
    double turn = TAU / LONGEST_ARC * held->arc, legs = 0.0;
    int stalled = 0;
    Leg leg;
    while (remaining > 0.0 && isfinite(now.state.velocity)) {
        legs += 1.0;
        if (legs > MOST_LEGS * (1.0 + clock.elapsed / turn)) {
            return refuse_work(refusal, duration, clock.elapsed, MOST_LEGS,
                               "series in a turn of the fastest oscillation");
        }
        double chi = now.psi + plant->phase;
        leg_onward(&leg, held, bristle, lifted, &now.state, now.bristle, now.theta, chi, tolerance);
        double switching = time_to_switch(&held->window, chi, q, lifted);
        double t = fmin(fmin(remaining, switching), leg.reach);
        Watch watch = leg_watch(&leg, t);
        double zero = first_zero(&watch, t, 0.0);
        bool stops = zero >= 0.0;
        if (stops) {
            t = zero;
        }
        double travelled;
        now.state = leg_end(&leg, t, &travelled);
        now.theta =
            period_advance(&now.means, t, now.theta, w, false, leg_travel, &leg, travelled);
        now.position += travelled;
        now.psi = within_turn(now.psi + q * t);
        now.bristle = bristle_after(bristle, now.bristle, travelled);
        if (travelled != 0.0 && now.counts.sliding != leg.direction) {
            now.counts = counts_slid(now.counts, leg.direction);
            now.event_age = 0.0;
        }
        now.event_age += t;
        if (stops) {
            now.state.velocity = 0.0;
        } else if (t == switching) {
            lifted = !lifted;
            now.event_age = 0.0;
        }
        stalled = 1e12 * t < held->arc ? stalled + 1 : 0;
        if (stalled > MOST_STALLED) {
            return refuse_stalling(refusal, duration, clock.elapsed);
        }
        remaining = t != remaining ? clock_advance(&clock, t) : 0.0;
    }
    now.mode = lifted ? LIFTED : lugre_mode_of(held, &now.state, now.psi);
    *after = now;
    return true;
}
