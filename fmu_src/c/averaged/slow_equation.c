#include "slow_equation.h"

#include "../base/constants.h"
#include "../base/elementary.h"
#include "../resolved/events.h"

/* What the steps of averaged motion are called where they are refused. */
static const char *const STEPS = "steps of averaged motion";

/* Error per step of the slow motion, relative to the fast velocity. */
#define TOLERANCE 2e-10

/* Step tried first, as a share of the time in which the strongest force changes the fast velocity. */
#define FIRST_STEP 0.1

/* Part of a beat that a step may have: its stages then see all phases of the normal load. */
#define BEAT_SHARE 0.125

/* Change of the velocity up to which its rate may be linear, over the fast velocity; and the share of the tolerance for
 * what that leaves: no step corrects it. */
#define LINEAR 4e-6
#define SETTLED 1e-2

/* Decay over a step below which a velocity is constant. */
#define NO_DECAY 1e-6

/* Number of waves of the normal load over a turn that doubles the cost of a quadrature. */
#define WAVES 10.0

/* Lower limit of the number of steps that is accepted. */
enum { MIN_STEPS = 16 };

/* Largest cost of a step under a growing load, relative to one under a constant load. */
enum { GROWING = 4 };

/* Frequency [rad/s] of a drive that moves nothing, so low that it ends no segment. */
#define STILL 1e-6

/* Motion without vibration is that of a block, resolved: only the normal load is averaged, unless it is slow itself. */
static bool pass_unshaken(const SlowFriction *friction, double duration, Budget *budget, SlowPoint *now,
                          Refusal *refusal) {
    System still = *friction->system;
    Plant *plant = &still.plant;
    double frequency = plant->normal_frequency, rate = plant->normal_rate;
    if (!friction->stands) {
        plant->friction_preload = slow_friction_at(friction, 0.0, INFINITY);
        plant->friction_amplitude = frequency = rate = 0.0;
        plant->window.exists = false;
    }
    double w = fmax(STILL, fmax(fabs(frequency), fabs(frequency + rate * duration)));
    plant->drive_frequency = w;
    system_ramp(&still, &(Ramp){frequency / w, plant->load_rate, rate / w}, duration);
    still.splits = split_prepare(&still.split, plant);
    still.friction = &COULOMB;
    Moment begin = {.state.velocity = now->velocity, .psi = friction->load.delta - plant->phase}, end;
    begin.mode = mode_by_velocity(&still, &begin);
    if (!events_advance(&still, &begin, duration, NULL, NULL, budget, &end, refusal)) {
        return false;
    }
    now->velocity = end.state.velocity;
    now->travel = end.position;
    return true;
}

static bool rate_at(void *motion, double t, double velocity, SlowRate *rate) {
    const SlowFriction *friction = motion;
    const Plant *plant = &friction->system->plant;
    double load = plant->load + plant->load_rate * t;
    double force = slow_friction_at(friction, t, velocity) + load;
    *rate = (SlowRate){-force / plant->total_mass, velocity};
    return true;
}

/* Steps of averaged motion that a whole budget buys. */
static int max_steps(const SlowFriction *friction) {
    bool costs_quadratures = is_elastic(&friction->bristle) && friction->table == NULL;
    if (!costs_quadratures) {
        return MAX_SLOW_STEPS / (friction->system->plant.load_rate != 0.0 ? GROWING : 1);
    }
    double waves = fmin(fabs(friction->system->inputs.frequency_ratio), MAX_WAVES);
    return (int)fmax(MIN_STEPS, MAX_QUADRATURE_STEPS / (1.0 + waves / WAVES));
}

/* The step [s] to try first; without force all the `duration`. */
static double first_step(const SlowFriction *friction, double duration) {
    const System *system = friction->system;
    const Plant *plant = &system->plant;
    double last_load = plant->load + plant->load_rate * duration;
    double strongest = plant->friction_preload + plant->friction_amplitude + fmax(fabs(plant->load), fabs(last_load));
    double change = system->fast.velocity * plant->total_mass;
    return strongest > 0.0 ? FIRST_STEP * change / strongest : duration;
}

/* One step of `h` [s] near a steady velocity, under rates that do not depend on time: the acceleration is linear in the
 * velocity, with a derivative `gain`; a positive one, which is rounding, counts as 0. The error is by the residual of
 * the acceleration at the end. Return false where the velocity would change by more than a share LINEAR of the fast
 * one. */
static bool linear_step(SlowFriction *friction, const SlowPoint *from, double gain, double h, SlowStep *step) {
    double acceleration = from->rate.acceleration, z = h * fmin(0.0, gain), decayed = exp(z);
    double mean = z < -NO_DECAY ? expm1(z) / z : 1.0, change = h * acceleration * mean;
    if (!(fabs(change) <= LINEAR * friction->fast.velocity)) {
        return false;
    }
    SlowPoint to = {.t = from->t + h, .velocity = from->velocity + change};
    rate_at(friction, to.t, to.velocity, &to.rate);
    double weight = z < -NO_DECAY ? (mean - decayed) / (1.0 - decayed) : 0.5;
    to.travel = from->travel + h * (to.rate.travel + weight * (from->rate.travel - to.rate.travel));
    double error = h * mean * fabs(to.rate.acceleration - decayed * acceleration);
    *step = (SlowStep){.to = to, .change = change, .error = error, .gain = z / h};
    return true;
}

/* Error of the velocity over a step by Simpson's rule, with one more rate in the middle: where friction has a kink, the
 * error of the embedded pair is small by accident now and then, but not both. */
static double simpson_error(SlowFriction *friction, const SlowPoint *from, const SlowStep *step) {
    double h = step->to.t - from->t, first = from->rate.acceleration, last = step->to.rate.acceleration;
    double middle = from->velocity + 0.5 * step->change + 0.125 * h * (first - last);
    SlowRate rate;
    rate_at(friction, from->t + 0.5 * h, middle, &rate);
    return fabs(step->change - h / 6.0 * (first + 4.0 * rate.acceleration + last));
}

/* In this order: refuse a time of too many steps; then step by step: pass all the rest in one step where the velocity
 * settles, or a step of the solver; take it over if its error is small enough. */
bool slow_pass(const SlowFriction *friction, double end, Budget *budget, SlowPoint *now, Refusal *refusal) {
    double fast = friction->fast.velocity, tolerance = TOLERANCE * fast, gain = 0.0;
    if (fast == 0.0) {
        return pass_unshaken(friction, end, budget, now, refusal);
    }
    SlowFriction own = *friction;
    bool varies = own.fastest != 0.0 || own.chirp != 0.0 || own.system->plant.load_rate != 0.0;
    double longest = BEAT_SHARE * own.beat, h = first_step(&own, end);
    int tried = 0, max_count = max_steps(&own), allowed = budget_left(budget, max_count);
    /* No step is longer than a share of a beat: too many of them are refused before the first. */
    if (varies && end > allowed * longest) {
        return budget_refuse(budget, allowed * longest, max_count, STEPS, refusal);
    }
    rate_at(&own, 0.0, now->velocity, &now->rate);
    for (; now->t < end && isfinite(now->velocity); tried++) {
        if (tried == allowed) {
            return budget_refuse(budget, now->t, max_count, STEPS, refusal);
        }
        double left = end - now->t;
        SlowStep step;
        bool settles =
            !varies && tried > 0 && linear_step(&own, now, gain, left, &step) && step.error <= SETTLED * tolerance;
        if (!settles) {
            h = fmin(fmin(h, longest), left);
            runge_kutta_step(rate_at, &own, now, h, &step);
            if (!(step.error > tolerance)) {
                step.error = fmax(step.error, simpson_error(&own, now, &step));
            }
        }
        if (!(step.error > tolerance)) {
            *now = step.to;
            now->t = settles || h == left ? end : now->t;
            gain = step.gain;
        }
        h *= step_growth(step.error, tolerance);
    }
    budget_spend(budget, tried, max_count);
    return true;
}
