/* A step during which inputs vary linearly.
 *
 * A phase that grows is a shift of the normal frequency: during the step psi grows instead, and at the end that growth
 * is moved to the phase. So the system of the step has a load and a normal frequency that may grow. */
#pragma once

#include "component_system.h"
#include "snapshot.h"

/* The moment after a step of `duration` [s] from `now` on under the system `present`, and the values `reached` there.
 * Refuses inputs that leave their bounds, and what the motion refuses; `after` is then undefined. */
bool ramped_step(const System *present, Tables *tables, const Snapshot *now, double duration, Budget *budget,
                 Moment *after, double reached[SETTABLE_COUNT], Refusal *refusal);
