/* The scale of velocities that tolerances of series refer to. */
#ifndef VELOCITY_SCALE_H
#define VELOCITY_SCALE_H

#include <math.h>

#include "plant.h"
#include "state.h"

/* Velocity [m/s] of drive, friction over a turn, and motion. */
static inline double velocity_scale(const Plant *plant, const State *state) {
    double w = plant->drive_frequency;
    double forces = plant->friction_preload + plant->friction_amplitude + fabs(plant->load);
    double swing =
        plant->mass_fraction * hypot(state->rate, plant->stick.frequency * state->displacement);
    return complex_abs(plant->drive) / w + forces / (plant->total_mass * w) +
           fabs(state->velocity) + swing;
}

#endif
