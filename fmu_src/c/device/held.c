#include "held.h"

#include <math.h>

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

bool held_prepare(Held *held, const Device *device, const Inputs *inputs, Refusal *refusal) {
    if (!plant_prepare(&held->plant, device, inputs, refusal)) {
        return false;
    }
    const Plant *plant = &held->plant;
    held->splits = split_prepare(&held->split, plant);
    held->window = flight_window(plant);
    held->arc = arc_of(plant, fabs(plant->normal_frequency));
    return true;
}

void held_ramp(Held *held, double load_rate, double normal_rate, double duration) {
    Plant *plant = &held->plant;
    double last = plant->normal_frequency + normal_rate * duration;
    plant->load_rate = load_rate;
    plant->normal_rate = normal_rate;
    held->arc = arc_of(plant, fmax(fabs(plant->normal_frequency), fabs(last)));
}
