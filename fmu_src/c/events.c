#include "events.h"

#include <math.h>

#include "clock.h"
#include "friction_law.h"
#include "leg.h"

/* Legs in a turn of the fastest oscillation up to which work is accepted: several times what
 * presliding on the hardest bristles takes. */
enum { MAX_LEGS = 20000 };

/* Legs since a turn of the fastest oscillation began at `began` [s]; a turn takes `turn` [s]. */
typedef struct {
    int legs;
    double began, turn;
} Work;

/* Counts a leg that begins at `time` [s]; whether its work is accepted. */
static bool work_count(Work *work, double time) {
    if (time - work->began > work->turn) {
        work->began = time;
        work->legs = 0;
    }
    work->legs++;
    return work->legs <= MAX_LEGS;
}

bool events_advance(const Law *law, const Moment *moment, double duration, Moment *now,
                    Refusal *refusal) {
    const FrictionLaw *friction = law->friction;
    const Held *held = &law->held;
    const Plant *plant = &held->plant;
    double remaining = duration;
    Clock clock = clock_of(duration);
    Work work = {.turn = TAU / LONGEST_ARC * held->arc};
    Leg leg;
    *now = *moment;
    leg.known.known = false;
    leg.departs = now->state.velocity == 0.0;
    moment_enter(now, friction->mode(law, now));
    while (remaining > 0.0 && isfinite(now->state.velocity)) {
        if (!work_count(&work, clock.elapsed)) {
            return refuse_work(refusal, duration, clock.elapsed, MAX_LEGS,
                               "legs in a turn of the fastest oscillation");
        }
        double switching = time_to_switch(&held->window, now->psi + plant->phase,
                                          plant->normal_frequency, now->mode == LIFTED);
        double longest = fmin(fmin(remaining, switching), held->arc);
        friction->follow(&leg, law, now, longest, switching);
        leg_finish(&leg, held, now);
        friction->succeed(&leg, law, now, leg.zero_of < 0 && leg.t == switching);
        leg.departs = now->state.velocity == 0.0 && now->mode != -leg.mode;
        remaining = leg.t == remaining ? 0.0 : clock_advance(&clock, leg.t);
    }
    return true;
}
