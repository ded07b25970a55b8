#include "system.h"

#include "../base/elementary.h"

/* The friction laws in the order of `friction_law`. */
static const FrictionLaw *const FRICTION_LAWS[] = {&COULOMB, &LUGRE};

/* The longest segment [s], under a normal frequency up to `highest` [rad/s]. */
static double arc_of(const Plant *plant, double highest) {
    double fastest = fmax(plant->drive_frequency, highest);
    if (plant->resolves_resonator && plant->slip.oscillatory) {
        fastest = fmax(fastest, plant->slip.frequency);
    }
    if (plant->resolves_resonator && plant->stick.oscillatory) {
        fastest = fmax(fastest, plant->stick.frequency);
    }
    return LONGEST_ARC / fastest;
}

bool system_prepare(System *system, const Device *device, const Inputs *inputs, Refusal *refusal) {
    *system = (System){.device = *device, .inputs = *inputs, .middle_ratio = inputs->frequency_ratio};
    system->friction = FRICTION_LAWS[device->friction_law];
    if (!system->friction->prepare(device, &system->bristle, refusal) ||
        !plant_prepare(&system->plant, device, inputs, refusal)) {
        return false;
    }
    system->fast = fast_vibration_of(device);
    system->splits = split_prepare(&system->split, &system->plant);
    system->arc = arc_of(&system->plant, fabs(system->plant.normal_frequency));
    return true;
}

int mode_by_velocity(const System *system, const Moment *moment) {
    return is_lifted(&system->plant, moment->psi) ? LIFTED : direction_of(moment->state.velocity);
}

void system_change(System *system, double phase, double load) {
    system->inputs.phase = system->plant.phase = phase;
    system->inputs.load = system->plant.load = load;
}

void system_ramp(System *system, const Ramp *ramp, double duration) {
    Plant *plant = &system->plant;
    double w = plant->drive_frequency;
    system->inputs.frequency_ratio = ramp->ratio;
    plant->normal_frequency = ramp->ratio * w;
    plant->load_rate = ramp->load_rate;
    plant->normal_rate = ramp->ratio_rate * w;
    double last = plant->normal_frequency + plant->normal_rate * duration;
    system->arc = arc_of(plant, fmax(fabs(plant->normal_frequency), fabs(last)));
}

double slow_velocity(const System *system, const State *state, double theta) {
    double momentum = state->velocity + device_mass_fraction(&system->device) * state->rate;
    return momentum + system->fast.pair_velocity * cos(theta);
}

System system_after(const System *system, double t) {
    System later = *system;
    Plant *plant = &later.plant;
    double passed = plant->normal_rate / plant->drive_frequency * t;
    plant->normal_frequency += plant->normal_rate * t;
    later.inputs.frequency_ratio += passed;
    later.middle_ratio += 0.5 * passed;
    later.inputs.load += plant->load_rate * t;
    plant->load = later.inputs.load;
    return later;
}
