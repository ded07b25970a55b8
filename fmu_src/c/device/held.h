/* A device under held inputs: all that depends on parameters and inputs alone. */
#pragma once

#include <stdbool.h>

#include "contact.h"
#include "plant.h"
#include "split_slide.h"

typedef struct {
    Plant plant;         /* coefficients of the equations of motion */
    bool splits;         /* whether sliding and flight use `split` */
    Split split;         /* their closed form, split into momentum and free oscillation */
    FlightWindow window; /* the phases of the normal load at which the contact is lifted */
    double arc;          /* longest leg [s]: after that a motion begins anew from its state */
} Held;

/* Prepares motion of `device` under `inputs`. Refuses as plant_prepare does. */
bool held_prepare(Held *held, const Device *device, const Inputs *inputs, Refusal *refusal);

/* Let the load grow by `load_rate` [N/s] and the normal frequency by `normal_rate` [rad/s^2] for
 * `duration` [s]. */
void held_ramp(Held *held, double load_rate, double normal_rate, double duration);
