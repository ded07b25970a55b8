#include "slow_motion_error.h"

#include "elementary.h"
#include "state.h"

/* Error of first order in friction shares and v_q: that of the average, and that of what the average leaves
 * out, the resonator's first swing and the first bend of bristles. */
#define FIRST_ORDER 2.0

/* Damping of bristles over Coulomb friction; 0 without bristles. A bristle bends over a path of 2 mu/s0 after
 * each of two reversals in a turn, and damps by the impulse of 2 mu s1/s0 per normal load; but by no more than
 * s1 v_q all the time. */
static double damping_of_bend(const Law *law) {
    const Device *device = &law->device;
    if (device->friction_law == 0) {
        return 0.0;
    }
    const Bristle *bristle = &law->bristle;
    double all_time = bristle->damping * law->fast.velocity / bristle->coefficient;
    double bends = 2.0 / PI * bristle->damping / bristle->stiffness * device->drive_frequency;
    return fmin(all_time, bends);
}

/* Share of mean friction in the inertia of the vibration, faces mu N0 / (Mt w v_q): the small number by which averages
 * expand. */
static double friction_share(const Law *law) {
    const Device *device = &law->device;
    double normal = fmax(device->normal_preload, device->normal_amplitude / PI);
    double friction = device->friction_faces * device->friction_coefficient * normal *
                      hypot(1.0, damping_of_bend(law));
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

/* Decay of the bend of a bristle in a turn, over a path of four times the amplitude; infinite without. */
static double bristle_decay(const Law *law) {
    if (law->device.friction_law == 0) {
        return INFINITY;
    }
    double path = 4.0 * law->fast.velocity / law->device.drive_frequency;
    return law->bristle.stiffness * path / law->bristle.coefficient;
}

double first_order_error(const Law *law) {
    double share = law->fast.velocity > 0.0 ? friction_share(law) : 0.0;
    if (!(share > 0.0)) {
        return 0.0;
    }
    double decay = fmin(decay_in_turn(law), bristle_decay(law));
    double swing = decay > 0.0 ? 1.0 + 1.0 / decay : INFINITY;
    return fmin(FIRST_ORDER * share * swing, 1.0) * law->fast.velocity;
}
