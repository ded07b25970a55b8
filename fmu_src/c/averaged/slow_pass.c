#include "slow_pass.h"

#include <math.h>

#include "../base/runge_kutta.h"

/* Step tried first, as a share of the time in which friction changes the fast velocity. */
#define FIRST_STEP 0.1

/* What must be left, in first steps, for the motion to settle. */
#define SETTLING 100.0

/* Part of a beat that a step may have: its stages then see all phases of the normal load. */
#define BEAT_SHARE 0.125

/* Part of a beat up to which a kink ahead counts as the one just passed. */
#define MIN_SHARE 1e-9

/* Steps before each of which it may turn out that the motion has settled. */
enum { BLOCK = 16 };

/* Shortest step to an edge of friction, as a share of the step tried first. */
#define MIN_APPROACH 1e-9

double slow_pass_step(double fast, double mass, double strongest, double duration) {
    return strongest > 0.0 ? FIRST_STEP * fast * mass / strongest : duration;
}

double time_to_stop(double u, double a, double j) {
    double square = a * a - 2.0 * j * u;
    if (square < 0.0) {
        return INFINITY;
    }
    if (a < 0.0) {
        return 2.0 * u / (sqrt(square) - a);
    }
    return j < 0.0 ? (a + sqrt(square)) / -j : INFINITY;
}

/* Time [s] until the motion gets to an edge of friction, by the acceleration of now and its growth; beyond
 * the edge, where friction is constant, that is exact. Near an edge known to a `margin` it is the time for so
 * short a way. Steps that end there leave no visit across an edge between their stages. */
static double to_edge(const SlowPass *pass, const Reached *now) {
    double middle = 0.5 * (pass->edge[0] + pass->edge[1]);
    int side = now->velocity > middle ? 1 : -1;
    double beyond = side * (now->velocity - pass->edge[side > 0]);
    double distance = fabs(beyond) - pass->margin;
    double a = pass->acceleration(pass->motion, now->t, now->velocity), time;
    if (distance < 0.0) {
        time = time_to_stop(pass->margin, -fabs(a), -fabs(pass->jerk) - pass->sway);
    } else {
        int away = beyond < 0.0 ? -side : side;
        time = time_to_stop(distance, away * a, away * pass->jerk - pass->sway);
    }
    return fmax(time, MIN_APPROACH * pass->step);
}

static bool rate_at(void *data, double t, double v, SlowRate *rate) {
    const SlowPass *pass = data;
    *rate = (SlowRate){pass->acceleration(pass->motion, t, v), v};
    return true;
}

/* Integrate to time `end` [s], or for `max_steps` accepted and rejected steps of at most `longest` [s]: over the period of
 * a periodic acceleration all stages would see the same value. */
static void integrate(const SlowPass *pass, double end, double longest, int max_steps, Reached *now) {
    SlowPass own = *pass;
    SlowPoint here = {.t = now->t, .velocity = now->velocity, .travel = now->moved};
    rate_at(&own, here.t, here.velocity, &here.rate);
    for (int count = 0; count < max_steps && here.t < end && isfinite(here.velocity); count++) {
        double left = end - here.t, h = fmin(fmin(now->step, longest), left);
        SlowStep step;
        now->tried++;
        runge_kutta_step(&DORMAND_PRINCE, rate_at, &own, &here, h, &step);
        if (!(step.error > pass->tolerance)) {
            here = step.to;
            here.t = h < left ? here.t : end;
        }
        now->step = h * step_growth(&DORMAND_PRINCE, step.error, pass->tolerance);
    }
    now->t = here.t;
    now->velocity = here.velocity;
    now->moved = here.travel;
}

bool slow_pass(const SlowPass *pass, double end, Budget *budget, Reached *now, Refusal *refusal) {
    const char *what = "steps of averaged motion";
    int allowed = budget_left(budget, pass->max_steps), before = now->tried;
    /* No step is longer than a share of a beat: too many of them are refused before the first. */
    double furthest = allowed * (BEAT_SHARE * pass->beat);
    if (!pass->may_settle && end - now->t > furthest) {
        return budget_refuse(budget, now->t + furthest, pass->max_steps, what, refusal);
    }
    bool grows = pass->jerk != 0.0;
    while (now->t < end && isfinite(now->velocity)) {
        int room = allowed - (now->tried - before);
        if (room <= 0) {
            return budget_refuse(budget, now->t, pass->max_steps, what, refusal);
        }
        bool may_settle = pass->may_settle && end - now->t > SETTLING * pass->step;
        if (may_settle && settle(pass->acceleration, pass->motion, pass->fast, end, now)) {
            break;
        }
        double kink = fmax(pass->to_kink(pass->motion, now->t), MIN_SHARE * pass->beat);
        double smooth = grows ? fmin(kink, to_edge(pass, now)) : kink;
        int block = grows ? 1 : room < BLOCK ? room : BLOCK;
        integrate(pass, fmin(end, now->t + smooth), BEAT_SHARE * pass->beat, block, now);
        /* A time too short for a step counts as one, so that the loop ends. */
        now->tried += now->tried == allowed - room + before;
    }
    budget_spend(budget, now->tried - before, pass->max_steps);
    return true;
}
