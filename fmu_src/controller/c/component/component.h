/* The controller between its law and FMI: values by reference, lifecycle, steps. */
#pragma once

#include <stdbool.h>
#include <stddef.h>

#include "../base/refusal.h"
#include "experiment.h"
#include "snapshot.h"

/* A velocity controller; `now` is its complete state. */
typedef struct {
    Snapshot now;
} Component;

/* A step takes the samples due from its start up to, but not including, its end. */
#include "component_functions.h"
