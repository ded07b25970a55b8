#include "slow_phase.h"

#include <math.h>

#include "../device/state.h"
#include "../device/vibrating_load.h"

/* Largest distance of the frequency ratio from an integer at which the phase counts as slow. Under a lifting
 * contact: largest distance of q times the ratio, times q, for q up to a few turns. */
#define NEAR 0.1

SlowPhase slow_phase_of(const Device *device, double ratio) {
    SlowPhase slow = {.turns = turns_to_repeat(device, ratio, NEAR), .waves = ratio};
    if (slow.turns > 0) {
        slow.waves = nearbyint(slow.turns * ratio) / slow.turns;
    }
    slow.drift = (ratio - slow.waves) * device->drive_frequency;
    slow.fastest = fabs(slow.drift);
    return slow;
}

SlowPhase slow_phase_chirped(const Device *device, double ratio, double middle, double chirp) {
    SlowPhase slow = slow_phase_of(device, middle);
    double last = middle + (middle - ratio), w = device->drive_frequency;
    slow.waves = slow.turns > 0 ? slow.waves : ratio;
    slow.drift = (ratio - slow.waves) * w;
    slow.fastest = fmax(fabs(slow.drift), fabs((last - slow.waves) * w));
    slow.chirp = chirp;
    return slow;
}

double next_slow_boundary(const Device *device, double ratio, double direction) {
    double next = INFINITY, from = direction * ratio;
    for (int turns = 1; turns <= max_turns_to_repeat(device); turns++) {
        double near = NEAR / turns, waves = turns * from;
        for (int side = -1; side <= 1; side += 2) {
            double offset = side * near;
            double boundary = (floor(waves - offset) + 1.0 + offset) / turns;
            next = fmin(next, boundary);
        }
    }
    return direction * next;
}

double slow_phase_beat(const SlowPhase *slow) {
    return slow->fastest != 0.0 ? TAU / ((slow->turns > 0 ? slow->turns : 1) * slow->fastest)
                                : INFINITY;
}
