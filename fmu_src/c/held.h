/* What stays the same while inputs and parameters do. */
#ifndef SLIDER_HELD_H
#define SLIDER_HELD_H

#include <stdbool.h>

#include "contact.h"
#include "plant.h"
#include "split_slide.h"

/* `splits`: whether `split` serves sliding and flight; `arc` [s]: the time after which a motion is
 * anchored anew. */
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
