#include "slow_motion_error.h"

#include "../base/elementary.h"
#include "../device/state.h"
#include "../friction/friction_law.h"

/* Error of first order in friction shares and v_q: that of the average, and that of what the average leaves
 * out, the resonator's first swing and the first bend of bristles. */
#define FIRST_ORDER 2.0

/* The fast motion of averages. */
static FastMotion fast_motion(const Law *law) {
    return (FastMotion){law->fast.velocity, law->device.drive_frequency};
}

/* Share of mean friction in the inertia of the vibration, faces mu N0 / (Mt w v_q): the small number by which averages
 * expand. */
static double friction_share(const Law *law) {
    const Device *device = &law->device;
    double normal = fmax(device->normal_preload, device->normal_amplitude / PI);
    FastMotion fast = fast_motion(law);
    double damping = law->friction->averaged->bend_damping(&law->bristle, &fast);
    double friction = device->friction_faces * device->friction_coefficient * normal * hypot(1.0, damping);
    return friction / (device_total_mass(device) * device->drive_frequency * law->fast.velocity);
}

/* Decay of the resonator's own vibration in a turn of the drive, the slower of two; infinite without resonator. */
static double decay_in_turn(const Law *law) {
    const Device *device = &law->device;
    if (device->resonator_mass == 0.0) {
        return INFINITY;
    }
    double free_share = device->slider_mass / device_total_mass(device);
    double wn = device->resonator_frequency, decay = device->damping_ratio * wn / free_share;
    double excess = decay * decay - wn * wn / free_share;
    double slower = excess > 0.0 ? wn * wn / free_share / (decay + sqrt(excess)) : decay;
    return slower * TAU / device->drive_frequency;
}

double first_order_error(const Law *law) {
    double share = law->fast.velocity > 0.0 ? friction_share(law) : 0.0;
    if (!(share > 0.0)) {
        return 0.0;
    }
    FastMotion fast = fast_motion(law);
    double bend_decay = law->friction->averaged->bend_decay(&law->bristle, &fast);
    double decay = fmin(decay_in_turn(law), bend_decay);
    double swing = decay > 0.0 ? 1.0 + 1.0 / decay : INFINITY;
    return fmin(FIRST_ORDER * share * swing, 1.0) * law->fast.velocity;
}
