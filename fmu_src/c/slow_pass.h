/* The slow velocity over a time: integrated, or settled. */
#ifndef SLIDER_SLOW_PASS_H
#define SLIDER_SLOW_PASS_H

#include <stdbool.h>

#include "dormand_prince.h"
#include "refusal.h"

/* How to pass: the `fast` velocity [m/s], the error per step [m/s], the `step` [s] tried first, whether
 * the motion may settle, and the most steps. `duration` [s] is that of the communication step. The
 * acceleration repeats after a `beat` [s], and is smooth for `to_kink(motion, t)` [s] from `t` [s] on. */
typedef struct {
    AccelerationFunction acceleration;
    double (*to_kink)(const void *motion, double t);
    const void *motion;
    double fast, tolerance, step, duration, beat;
    bool may_settle;
    int most;
} SlowPass;

/* The step [s] to try first: a share of the time in which the `strongest` force [N] changes the fast
 * velocity of a mass [kg]; without force all the `duration`. */
double slow_pass_step(double fast, double mass, double strongest, double duration);

/* Bring `now` to time `end` [s]; one that settles takes few steps, however long the time. Refuses, with
 * `now` undefined, where that takes too many. */
bool slow_pass(const SlowPass *pass, double end, Reached *now, Refusal *refusal);

#endif
