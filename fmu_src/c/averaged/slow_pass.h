/* The slow velocity over a time: integrated, or settled. */
#ifndef SLIDER_SLOW_PASS_H
#define SLIDER_SLOW_PASS_H

#include <stdbool.h>

#include "../base/refusal.h"
#include "../device/budget.h"
#include "settling.h"

/* How to pass: the `fast` velocity [m/s], the error per step [m/s], the `step` [s] tried first, whether the motion
 * may settle, and the `max_steps` that a whole budget buys. The acceleration repeats after a `beat` [s], and is
 * smooth for `to_kink(motion, t)` [s] from `t` [s] on. Under a load that grows, with `jerk` [m/s^3], friction has an
 * `edge` [m/s] backward and one forward, known to a `margin` [m/s], beyond which it no longer depends on the
 * velocity; there it may speed the motion with up to `sway` [m/s^3] besides. */
typedef struct {
    AccelerationFunction acceleration;
    double (*to_kink)(const void *motion, double t);
    const void *motion;
    double fast, tolerance, step, beat;
    bool may_settle;
    int max_steps;
    double edge[2], margin, jerk, sway;
} SlowPass;

/* Time [s] until a velocity u >= 0 with acceleration a + j t is 0 again; infinite if it never is. */
double time_to_stop(double u, double a, double j);

/* The step [s] to try first: a share of the time in which the `strongest` force [N] changes the fast
 * velocity of a mass [kg]; without force all the `duration`. */
double slow_pass_step(double fast, double mass, double strongest, double duration);

/* Bring `now` to time `end` [s]; one that settles takes few steps, however long the time. Refuses, with
 * `now` undefined, where that takes more than the budget has. */
bool slow_pass(const SlowPass *pass, double end, Budget *budget, Reached *now, Refusal *refusal);

#endif
