#include "law.h"

#include "../base/elementary.h"

/* The friction laws in the order of `friction_law`. */
static const FrictionLaw *const FRICTION_LAWS[] = {&COULOMB, &LUGRE};

/* The longest leg [s], under a normal frequency up to `highest` [rad/s]. */
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

bool law_prepare(Law *law, const Device *device, const Inputs *inputs, Refusal *refusal) {
    *law = (Law){.device = *device, .inputs = *inputs, .middle_ratio = inputs->frequency_ratio};
    law->friction = FRICTION_LAWS[device->friction_law];
    if (!law->friction->prepare(device, &law->bristle, refusal) ||
        !plant_prepare(&law->plant, device, inputs, refusal)) {
        return false;
    }
    law->fast = fast_vibration_of(device);
    law->splits = split_prepare(&law->split, &law->plant);
    law->arc = arc_of(&law->plant, fabs(law->plant.normal_frequency));
    return true;
}

int mode_by_velocity(const Law *law, const Moment *moment) {
    const Plant *plant = &law->plant;
    bool lifted = is_lifted(plant, moment->psi + plant->phase, plant->normal_frequency);
    return lifted ? LIFTED : direction_of(moment->state.velocity);
}

void law_change(Law *law, double phase, double load) {
    law->inputs.phase = law->plant.phase = phase;
    law->inputs.load = law->plant.load = load;
}

void law_ramp(Law *law, const Ramp *ramp, double duration) {
    Plant *plant = &law->plant;
    double w = plant->drive_frequency;
    law->inputs.frequency_ratio = ramp->ratio;
    plant->normal_frequency = ramp->ratio * w;
    plant->load_rate = ramp->load_rate;
    plant->normal_rate = ramp->ratio_rate * w;
    double last = plant->normal_frequency + plant->normal_rate * duration;
    law->arc = arc_of(plant, fmax(fabs(plant->normal_frequency), fabs(last)));
}

double slow_velocity(const Law *law, const State *state, double theta) {
    double momentum = state->velocity + device_mass_fraction(&law->device) * state->rate;
    return momentum + law->fast.pair_velocity * cos(theta);
}

Law law_after(const Law *law, double t) {
    Law later = *law;
    Plant *plant = &later.plant;
    double passed = plant->normal_rate / plant->drive_frequency * t;
    plant->normal_frequency += plant->normal_rate * t;
    later.inputs.frequency_ratio += passed;
    later.middle_ratio += 0.5 * passed;
    later.inputs.load += plant->load_rate * t;
    plant->load = later.inputs.load;
    return later;
}
