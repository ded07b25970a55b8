#include "fast_vibration.h"

#include <math.h>

#include "plant.h"

bool fast_vibration_prepare(FastVibration *fast, const Device *device, Refusal *refusal) {
    double w = device->drive_frequency;
    double shaken = device->resonator_mass * device->base_amplitude * w * w;
    Complex force;
    if (!equivalent_force(device, &force, refusal) ||
        !steady_resonator(device, &fast->resonator, refusal)) {
        return false;
    }
    fast->velocity = fast_velocity(device, force);
    fast->pair_velocity = (shaken + device->tangential_force) / (device_total_mass(device) * w);
    fast->lag = force_lag(force);
    return true;
}
