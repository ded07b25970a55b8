/* The slow equation (M + m) V' = -mean friction - load, over a time. */
#pragma once

#include "../base/runge_kutta.h"
#include "../device/budget.h"
#include "slow_friction.h"

/* Bring `now`, at time 0, to time `end` [s]: its velocity settles in few steps, however long the time. Refuses, with
 * `now` undefined, where that takes more than the budget has. Without vibration it is the motion of a block. */
bool slow_pass(const SlowFriction *friction, double end, Budget *budget, SlowPoint *now, Refusal *refusal);
