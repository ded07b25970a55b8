/* The component between numerics and FMI: values by reference, time, initialization, steps. */
#ifndef SLIDER_COMPONENT_H
#define SLIDER_COMPONENT_H

#include <stdbool.h>
#include <stddef.h>

#include "experiment.h"
#include "friction_table.h"
#include "law.h"
#include "outputs.h"
#include "refusal.h"
#include "snapshot.h"

/* A slider-resonator. `now` is all that decides how a run goes on. The rest follows from it and is
 * kept beside: the law of the present values (where `prepared`) in one of two places, so that the
 * next one can be tried in the other. A component must not move: its laws point to its table. */
typedef struct {
    Snapshot now;
    bool prepared;
    int present;
    Law laws[2];
    FrictionTable table;
    Theory theory;
} Component;

#include "component_functions.h"

#endif
