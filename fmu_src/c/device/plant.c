#include "plant.h"

#include "../base/elementary.h"
#include "../base/refusal_texts.h"

/* Relative difference of two squared frequencies that is due to rounding: without damping the steady force has no
 * correct digit there. */
#define AT_RESONANCE (8.0 * EPSILON)

/* Whether undamped resonance leaves no steady vibration. */
static bool is_unbounded(const Device *device, const Oscillator *oscillator) {
    double square = device->drive_frequency * device->drive_frequency;
    return device->damping_ratio == 0.0 && fabs(oscillator->stiffness - square) <= AT_RESONANCE * square;
}

/* The resonator against a free slider (eq. 31 divided by 1 - r_m), or against a `held` one. */
static Oscillator resonator_of(const Device *device, bool held) {
    double free_share = held ? 1.0 : device->slider_mass / device_total_mass(device);
    double wn = device->resonator_frequency;
    return oscillator_of(device->damping_ratio * wn / free_share, wn * wn / free_share);
}

/* Steady vibration on a free or a `held` slider as complex amplitudes of e: displacement of the `resonator` [m] (eqs
 * 31-32), a direct drive included, and F_T* exp(-i theta_1) of eqs (33)-(34) with the direct drive added, `force` [N].
 * Refuses where it is unbounded. */
static bool steady_vibration(const Device *device, bool held, Complex *resonator, Complex *force, Refusal *refusal) {
    double w = device->drive_frequency, direct = held ? 0.0 : device->tangential_force / device->slider_mass;
    Oscillator oscillator = resonator_of(device, held);
    if (is_unbounded(device, &oscillator)) {
        return refuse_unbounded_resonance(refusal, device->damping_ratio, w);
    }
    *resonator = complex_scale(device->base_amplitude * w * w - direct, transfer(&oscillator, w));
    Complex swing = complex_of(resonator->re + device->base_amplitude, resonator->im);
    *force = complex_scale(device->resonator_mass * (w * w), swing);
    force->re += device->tangential_force;
    return true;
}

double held_amplitude(const Device *device) {
    Complex resonator, force = {0.0, 0.0};
    Refusal refusal;
    return steady_vibration(device, true, &resonator, &force, &refusal) ? complex_abs(force) : INFINITY;
}

FastVibration fast_vibration_of(const Device *device) {
    double w = device->drive_frequency, mass = device_total_mass(device);
    double shaken = device->resonator_mass * device->base_amplitude * w * w;
    FastVibration fast = {0};
    Complex force = {0.0, 0.0};
    Refusal refusal;
    if (steady_vibration(device, false, &fast.resonator, &force, &refusal)) {
        fast.velocity = complex_abs(force) / (mass * w);
        fast.pair_velocity = (shaken + device->tangential_force) / (mass * w);
        /* Adding 0 makes -0 a 0, which atan2 distinguishes. */
        fast.lag = -elementary_atan2(force.im + 0.0, force.re);
    }
    return fast;
}

double turning_at(double velocity, double fast_velocity) {
    if (fabs(velocity) >= fast_velocity) {
        return velocity > 0.0 ? 0.0 : PI;
    }
    return acos(velocity / fast_velocity);
}

static FlightWindow flight_window(const Device *device) {
    double preload = device->normal_preload, amplitude = device->normal_amplitude;
    if (preload >= amplitude) {
        return (FlightWindow){preload == 0.0, 0.0, TAU};
    }
    double dip = asin(preload / amplitude);
    return (FlightWindow){true, PI + dip, TAU - dip};
}

bool plant_prepare(Plant *plant, const Device *device, const Inputs *inputs, Refusal *refusal) {
    double w = device->drive_frequency, wn = device->resonator_frequency;
    double m = device->resonator_mass, total = device_total_mass(device);
    double faces_mu = device->friction_faces * device->friction_coefficient;
    bool full = device->fidelity == 2;
    double base_acceleration = device->base_amplitude * w * w;
    Complex force = complex_of(m * base_acceleration + device->tangential_force, 0.0);
    Complex resonator;
    if (!full && !steady_vibration(device, false, &resonator, &force, refusal)) {
        return false;
    }
    plant->slider_mass = full ? device->slider_mass : total;
    plant->total_mass = total;
    plant->mass_fraction = full ? device_mass_fraction(device) : 0.0;
    plant->drive_frequency = w;
    plant->normal_frequency = inputs->frequency_ratio * w;
    plant->phase = inputs->phase;
    plant->load = inputs->load;
    plant->load_rate = plant->normal_rate = 0.0;
    plant->friction_preload = faces_mu * device->normal_preload;
    plant->friction_amplitude = faces_mu * device->normal_amplitude;
    plant->window = flight_window(device);
    plant->slip = resonator_of(device, false);
    plant->stick = resonator_of(device, true);
    plant->drive = complex_of(force.re / total, force.im / total);
    plant->relative_drive = base_acceleration - device->tangential_force / device->slider_mass;
    plant->base_acceleration = base_acceleration;
    plant->holding_drive = full ? complex_of(device->tangential_force, 0.0) : force;
    plant->spring = full ? m * wn * wn : 0.0;
    plant->damper = full ? 2.0 * device->damping_ratio * m * wn : 0.0;
    plant->resolves_resonator = full;
    return true;
}

Plant plant_held(const Plant *plant) {
    Plant held = *plant;
    held.slider_mass = held.total_mass = INFINITY;
    held.mass_fraction = 0.0;
    held.slip = held.stick;
    held.drive = complex_of(0.0, 0.0);
    held.relative_drive = held.base_acceleration;
    return held;
}
