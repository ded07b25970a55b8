#include "law.h"

#include "coulomb.h"
#include "lugre.h"
#include "refusal_texts.h"
#include "slow_motion.h"

enum { COULOMB = 0, AVERAGED = 0 };

/* Without friction (8) has no meaning. */
static bool require_bristle(const Device *device, Refusal *refusal) {
    return device->friction_law == COULOMB || device->friction_coefficient != 0.0
           || refuse_lugre_without_friction(refusal, device->friction_coefficient);
}

bool law_prepare(Law *law, const Device *device, const Inputs *inputs, FrictionTable *table,
                 Refusal *refusal) {
    law->device = *device;
    law->inputs = *inputs;
    law->bristle = bristle_of(device);
    law->table = table;
    if (device->fidelity == AVERAGED) {
        return require_bristle(device, refusal) &&
               held_prepare(&law->held, device, inputs, refusal) &&
               fast_vibration_prepare(&law->fast, device, refusal);
    }
    return held_prepare(&law->held, device, inputs, refusal) && require_bristle(device, refusal);
}

Moment law_start(const Law *law) {
    const Device *device = &law->device;
    State state = {device->initial_velocity, device->initial_resonator_displacement,
                   device->initial_resonator_velocity};
    if (device->fidelity == AVERAGED) {
        return slow_start(law, state, device->initial_position);
    }
    if (device->friction_law == COULOMB) {
        return coulomb_start(&law->held, state, device->initial_position);
    }
    return lugre_start(&law->held, &law->bristle, state, device->initial_position,
                       device->initial_bristle_deflection);
}

bool law_advance(const Law *law, const Moment *moment, double duration, Moment *after,
                 Refusal *refusal) {
    const Device *device = &law->device;
    if (device->fidelity == AVERAGED) {
        return slow_advance(law, moment, duration, after, refusal);
    }
    if (device->friction_law == COULOMB) {
        return coulomb_advance(&law->held, moment, duration, after, refusal);
    }
    return lugre_advance(&law->held, &law->bristle, device->tolerance, moment, duration, after,
                         refusal);
}

int law_mode(const Law *law, const Moment *moment) {
    if (law->device.fidelity != AVERAGED && law->device.friction_law == COULOMB) {
        return coulomb_mode_of(&law->held, &moment->state, moment->theta, moment->psi);
    }
    return lugre_mode_of(&law->held, &moment->state, moment->psi);
}

double law_friction_force(const Law *law, const Moment *moment, int mode) {
    if (law->device.fidelity == AVERAGED) {
        return slow_friction_force(law, moment);
    }
    if (law->device.friction_law == COULOMB) {
        return coulomb_friction_force(&law->held, moment, mode);
    }
    return lugre_friction_force(&law->held, &law->bristle, moment, mode);
}
