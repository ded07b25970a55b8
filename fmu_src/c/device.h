/* Parameters and inputs by the names of the interface (SI units). */
#ifndef SLIDER_DEVICE_H
#define SLIDER_DEVICE_H

typedef struct {
    double slider_mass;
    double resonator_mass;
    double resonator_frequency;
    double damping_ratio;
    double normal_preload;
    double normal_amplitude;
    double base_amplitude;
    double drive_frequency;
    double tangential_force;
    double friction_coefficient;
    int friction_faces;
    int friction_law;
    double bristle_stiffness;
    double bristle_damping;
    int fidelity;
    double tolerance;
    double initial_position;
    double initial_velocity;
    double initial_resonator_displacement;
    double initial_resonator_velocity;
    double initial_bristle_deflection;
} Device;

/* `phase` is kept in [-pi, pi]. */
typedef struct {
    double phase;
    double load;
    double frequency_ratio;
} Inputs;

static inline double device_total_mass(const Device *device) {
    return device->slider_mass + device->resonator_mass;
}

/* Share of the resonator in the total mass, r_m (below eq. 29). */
static inline double device_mass_fraction(const Device *device) {
    return device->resonator_mass / device_total_mass(device);
}

#endif
