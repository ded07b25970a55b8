/* The component between numerics and FMI: values by reference, lifecycle, steps. */
#ifndef SLIDER_COMPONENT_H
#define SLIDER_COMPONENT_H

#include <stdbool.h>
#include <stddef.h>

#include "experiment.h"
#include "friction_table.h"
#include "law.h"
#include "orbit_tables.h"
#include "outputs.h"
#include "refusal.h"
#include "snapshot.h"

/* A slider-resonator. `now` is its complete state; the rest is a cache of what follows from it:
 * laws[present] is the law of the present values where `prepared`, the other place serves to try the
 * next one; `resolved` are the laws of the full device where averages of second order need them. A component must not move in memory: its laws point to its table. */
typedef struct {
    Snapshot now;
    bool prepared;
    int present;
    Law laws[2], resolved[2];
    FrictionTable table;
    OrbitTables orbits;
    Theory theory;
} Component;

#include "component_functions.h"

#endif
