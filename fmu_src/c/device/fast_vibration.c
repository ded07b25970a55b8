#include "fast_vibration.h"

#include "plant.h"

bool fast_vibration_prepare(FastVibration *fast, const Device *device, Refusal *refusal) {
    double w = device->drive_frequency, mass = device_total_mass(device);
    double shaken = device->resonator_mass * device->base_amplitude * w * w;
    Complex force;
    if (!equivalent_force(device, &force, refusal) ||
        !steady_resonator(device, &fast->resonator, refusal)) {
        return false;
    }
    fast->velocity = complex_abs(force) / (mass * w);
    fast->pair_velocity = (shaken + device->tangential_force) / (mass * w);
    /* Adding 0 makes -0 a 0, which atan2 distinguishes. */
    fast->lag = -elementary_atan2(force.im + 0.0, force.re);
    return true;
}
