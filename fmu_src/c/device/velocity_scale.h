/* The scale of velocities to which tolerances refer. */
#ifndef VELOCITY_SCALE_H
#define VELOCITY_SCALE_H

#include <math.h>

#include "../base/complex_number.h"
#include "plant.h"
#include "state.h"

/* Sum [m/s] of the velocity amplitude of the drive, the velocity that friction and load change in a radian of
 * the drive, and the velocities of slider and resonator. */
static inline double velocity_scale(const Plant *plant, const State *state) {
    double w = plant->drive_frequency;
    double load = fabs(plant->load) + fabs(plant->load_rate) / w;
    double forces = plant->friction_preload + plant->friction_amplitude + load;
    Complex swing = complex_of(state->rate, plant->stick.frequency * state->displacement);
    return complex_abs(plant->drive) / w + forces / (plant->total_mass * w) +
           fabs(state->velocity) + plant->mass_fraction * complex_abs(swing);
}

#endif
