/* A step during which inputs vary linearly.
 *
 * A phase that grows is another frequency of the normal load: during the step its rate belongs to psi,
 * and at the end the phase has what psi gained. So such a step is one of a law whose load and normal
 * frequency may grow. */
#ifndef RAMPED_STEP_H
#define RAMPED_STEP_H

#include <stdbool.h>

#include "component_law.h"
#include "snapshot.h"

/* The law during the step, where it follows orbits that of the full device, and the values at the end. */
typedef struct {
    Law law, resolved;
    double reached[SETTABLE_COUNT];
} RampedStep;

/* The moment after a step of `duration` [s] from `now` on. Refuses inputs that leave their bounds, and
 * what law_advance refuses; `after` is then undefined. */
bool ramped_step(RampedStep *step, const Snapshot *now, double duration, FrictionTable *table,
                 OrbitTables *orbits, Moment *after, Refusal *refusal);

#endif
