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

/* Angle [rad] of the fastest oscillation after which a motion is anchored anew: keeps the rounding
 * of large arguments of sine and cosine out. */
#define LONGEST_ARC 60.0

/* Prepares motion of `device` under `inputs`. Refuses as plant_prepare does. */
bool held_prepare(Held *held, const Device *device, const Inputs *inputs, Refusal *refusal);

#endif
