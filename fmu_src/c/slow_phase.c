#include "slow_phase.h"

#include <math.h>

#include "state.h"
#include "vibrating_load.h"

/* Distance of the frequency ratio from an integer up to which the phase counts as slow; under a
 * lifting contact that of q times the ratio, times q, for q of a few turns. */
#define NEAR 0.1

SlowPhase slow_phase_of(const Device *device, double ratio) {
    SlowPhase slow = {.turns = turns_to_repeat(device, ratio, NEAR), .waves = ratio};
    if (slow.turns > 0) {
        slow.waves = nearbyint(slow.turns * ratio) / slow.turns;
    }
    slow.drift = (ratio - slow.waves) * device->drive_frequency;
    return slow;
}

double slow_phase_beat(const SlowPhase *slow) {
    return slow->drift != 0.0 ? TAU / ((slow->turns > 0 ? slow->turns : 1) * fabs(slow->drift))
                              : INFINITY;
}
