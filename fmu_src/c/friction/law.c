#include "law.h"

/* The friction laws in the order of `friction_law`. */
static const FrictionLaw *const FRICTION_LAWS[] = {&COULOMB, &LUGRE};

bool law_prepare(Law *law, const Device *device, const Inputs *inputs, Refusal *refusal) {
    *law = (Law){.device = *device, .inputs = *inputs, .middle_ratio = inputs->frequency_ratio};
    law->friction = FRICTION_LAWS[device->friction_law];
    return law->friction->prepare(device, &law->bristle, refusal) &&
           held_prepare(&law->held, device, inputs, refusal);
}

void law_change(Law *law, double phase, double load) {
    law->inputs.phase = law->held.plant.phase = phase;
    law->inputs.load = law->held.plant.load = load;
}

void law_ramp(Law *law, const Ramp *ramp, double duration) {
    double w = law->held.plant.drive_frequency;
    law->inputs.frequency_ratio = ramp->ratio;
    law->held.plant.normal_frequency = ramp->ratio * w;
    held_ramp(&law->held, ramp->load_rate, ramp->ratio_rate * w, duration);
}

Law law_after(const Law *law, double t) {
    Law later = *law;
    Plant *plant = &later.held.plant;
    double passed = plant->normal_rate / plant->drive_frequency * t;
    plant->normal_frequency += plant->normal_rate * t;
    later.inputs.frequency_ratio += passed;
    later.middle_ratio += 0.5 * passed;
    later.inputs.load += plant->load_rate * t;
    plant->load = later.inputs.load;
    return later;
}
