/* A device under held inputs: all that depends on parameters and inputs alone. */
#ifndef SLIDER_HELD_H
#define SLIDER_HELD_H

#include <stdbool.h>

#include "contact.h"
#include "plant.h"
#include "split_slide.h"

/* `splits`: whether sliding and flight use `split`; `arc` [s]: the longest leg, after which a motion begins
 * anew from its state. */
typedef struct {
    Plant plant;
    bool splits;
    Split split;
    FlightWindow window;
    double arc;
} Held;

/* Prepares motion of `device` under `inputs`. Refuses as plant_prepare does. */
bool held_prepare(Held *held, const Device *device, const Inputs *inputs, Refusal *refusal);

/* Let the load grow by `load_rate` [N/s] and the normal frequency by `normal_rate` [rad/s^2] for
 * `duration` [s]. */
void held_ramp(Held *held, double load_rate, double normal_rate, double duration);

#endif
