#include "prediction.h"

#include <math.h>

#include "../base/angle.h"
#include "../device/vibrating_load.h"
#include "../friction/law.h"
#include "steady_motion.h"

/* Largest number of turns after which the normal load may repeat. */
enum { MAX_TURNS_OF_LOAD = 32 };

int turns_of_load(const Law *law) {
    if (law->device.normal_amplitude == 0.0) {
        return 1;
    }
    double ratio = law->inputs.frequency_ratio;
    for (int turns = 1; turns <= MAX_TURNS_OF_LOAD; turns++) {
        if (fabs(turns * ratio - nearbyint(turns * ratio)) <= EXACT) {
            return turns;
        }
    }
    return 0;
}

/* The law of the full device under the same inputs. */
static bool full_law(const Law *law, Law *full) {
    Device device = law->device;
    Refusal refusal;
    device.fidelity = 2;
    if (!law_prepare(full, &device, &law->inputs, &refusal)) {
        return false;
    }
    full->bending = law->bending;
    return true;
}

Averaged prediction_of(const Law *law, double normal_lead) {
    Averaged prediction = averaged(law, normal_lead);
    if (law->device.averaging_order == 1 || !prediction.valid) {
        return prediction;
    }
    Law full;
    PeriodMap map;
    Periodic steady, blocked;
    int turns = turns_of_load(law);
    prediction.valid = turns > 0 && full_law(law, &full) && period_map_prepare(&map, &full, turns);
    if (prediction.valid) {
        double psi = within_turn(normal_lead + law->inputs.frequency_ratio * map.section);
        prediction.valid = find_steady(&map, psi, prediction.steady_velocity, &steady) &&
                           find_blocked(&map, psi, prediction.blocking_force, &blocked);
    }
    if (prediction.valid) {
        prediction.steady_velocity = steady.velocity;
        prediction.blocking_force = blocked.load;
    }
    return prediction;
}
