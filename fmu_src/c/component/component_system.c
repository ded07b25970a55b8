#include "component_system.h"

#include "../averaged/friction_table.h"
#include "../friction/bending_kernels.h"
#include "parameter_values.h"
#include "values.h"

bool all_finite(const double *numbers, size_t count) {
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(numbers[i])) {
            return false;
        }
    }
    return true;
}

/* Whether all coefficients are finite numbers, and so are bounds of what motion and averages compute: the square of the
 * fast velocity [m^2/s^2], the drag over mu, and the integrals of load and friction [N]. The slider's mass must count
 * beside the resonator's. */
static bool system_is_finite(const System *system) {
    const Plant *plant = &system->plant;
    const Device *device = &system->device;
    double fast = system->fast.velocity;
    double mu = system->bristle.coefficient;
    double drag = system->bristle.damping * fmax(fast, fabs(device->initial_velocity));
    double drag_over_mu = drag / (mu > 0.0 ? mu : 1.0); /* without friction there is no drag */
    double bent = fabs(bristle_bent(&system->bristle, device->initial_bristle_deflection));
    double friction = device->friction_faces * (mu + drag + bent * (1.0 + drag_over_mu));
    double strongest = TAU * (device->normal_preload + device->normal_amplitude) * (1.0 + friction);
    double sum = plant->total_mass + plant->mass_fraction + plant->normal_frequency + plant->slip.decay +
                 plant->slip.stiffness + plant->stick.decay + plant->stick.stiffness + plant->drive.re +
                 plant->drive.im + plant->relative_drive + plant->base_acceleration + plant->holding_drive.re +
                 plant->holding_drive.im + plant->spring + plant->damper + fast * fast + drag_over_mu + strongest;
    return plant->mass_fraction < 1.0 && isfinite(sum);
}

/* Refuse values that together leave the range of floating point numbers; the text names the value that is the most
 * decades away from its start value. */
static bool refuse_extreme(const double values[SETTABLE_COUNT], Refusal *refusal) {
    size_t furthest = 0;
    double largest = -1.0;
    for (size_t i = 0; i < SETTABLE_COUNT; i++) {
        double start = VARIABLES[i].start != 0.0 ? VARIABLES[i].start : 1.0;
        double distance = values[i] != 0.0 ? fabs(log10(fabs(values[i])) - log10(start)) : 0.0;
        if (distance > largest) {
            largest = distance;
            furthest = i;
        }
    }
    char value[NUMBER_SIZE], start[NUMBER_SIZE];
    const Variable *variable = &VARIABLES[furthest];
    return refuse_extreme_value(refusal, variable->name, value_text(variable, values[furthest], value),
                                value_text(variable, variable->start, start));
}

Inputs reduced_inputs(const double values[SETTABLE_COUNT]) {
    Inputs inputs = inputs_of(values);
    inputs.phase = remainder(inputs.phase, TAU);
    return inputs;
}

/* The device of `values`, with the deviations of its drive. */
static Device driven_device(const double values[SETTABLE_COUNT]) {
    Device device = device_of(values);
    device.base_amplitude *= 1.0 + values[VR_AMPLITUDE_DEVIATION];
    device.tangential_force *= 1.0 + values[VR_AMPLITUDE_DEVIATION];
    device.drive_frequency *= 1.0 + values[VR_FREQUENCY_DEVIATION];
    return device;
}

/* The motion of a device, by its fidelity and averaging order; `device` becomes the one that this motion moves. */
static const Motion *motion_of(Device *device) {
    if (device->fidelity != 0) {
        return &RESOLVED_MOTION;
    }
    if (device->averaging_order == 1) {
        return &AVERAGED_MOTION;
    }
    device->fidelity = 2; /* leaps are over periods of the full device */
    return &LEAPING_MOTION;
}

/* A table of `size` bytes: the one that is `kept`, or a new one, NULL if out of memory. */
static void *table_of(const Memory *memory, void *kept, size_t size) {
    return kept != NULL ? kept : memory->allocate(memory->host, size);
}

/* Make the table that a system needs, and let it point to that. */
static bool provide_table(Tables *tables, System *system, Refusal *refusal) {
    if (!is_elastic(&system->bristle)) {
        return true;
    }
    if (system->motion == &AVERAGED_MOTION) {
        tables->means = table_of(&tables->memory, tables->means, sizeof *tables->means);
        system->tables = tables->means;
    } else {
        tables->bending = table_of(&tables->memory, tables->bending, sizeof *tables->bending);
        system->bending = tables->bending;
    }
    return system->tables != NULL || system->bending != NULL ||
           refuse(refusal, "out of memory: the host gives none for tables of friction");
}

bool prepare_system(const double values[SETTABLE_COUNT], Tables *tables, System *system, Refusal *refusal) {
    Device device = driven_device(values);
    Inputs inputs = reduced_inputs(values);
    const Variable *frequency = &VARIABLES[VR_DRIVE_FREQUENCY];
    if (device.drive_frequency < frequency->minimum) {
        return refuse_drive_too_slow(refusal, inputs.frequency_deviation, device.drive_frequency,
                                     frequency->requirement);
    }
    const Motion *motion = motion_of(&device);
    if (!system_prepare(system, &device, &inputs, refusal)) {
        return false;
    }
    system->motion = motion;
    return (system_is_finite(system) || refuse_extreme(values, refusal)) && provide_table(tables, system, refusal);
}
