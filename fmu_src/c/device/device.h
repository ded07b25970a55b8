/* The device: its parameters, the masses that follow from them, and what moves. */
#pragma once

#include "../base/number.h"
#include "parameters.h"

/* Mass of slider and resonator [kg]. */
static inline double device_total_mass(const Device *device) {
    return device->slider_mass + device->resonator_mass;
}

/* Resonator mass over total mass, r_m (below eq. 29). */
static inline double device_mass_fraction(const Device *device) {
    return device->resonator_mass / device_total_mass(device);
}

/* Mean friction [N] of sliding in one direction, but for the shape of a clipped load. */
static inline double full_friction(const Device *device) {
    double normal = fmax(device->normal_preload, device->normal_amplitude / PI);
    return device->friction_faces * device->friction_coefficient * normal;
}

/* Slider velocity [m/s], resonator displacement [m] and velocity [m/s]. */
typedef struct {
    double velocity, displacement, rate;
} State;
