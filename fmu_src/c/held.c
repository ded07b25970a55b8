#include "held.h"

#include <math.h>

bool held_prepare(Held *held, const Device *device, const Inputs *inputs, Refusal *refusal) {
    if (!plant_prepare(&held->plant, device, inputs, refusal)) {
        return false;
    }
    const Plant *plant = &held->plant;
    double fastest = fmax(plant->drive_frequency, fabs(plant->normal_frequency));
    if (plant->resolves_resonator && plant->slip.oscillatory) {
        fastest = fmax(fastest, plant->slip.frequency);
    }
    if (plant->resolves_resonator && plant->stick.oscillatory) {
        fastest = fmax(fastest, plant->stick.frequency);
    }
    held->splits = split_prepare(&held->split, plant);
    held->window = flight_window(plant);
    held->arc = LONGEST_ARC / fastest;
    return true;
}
