#include "period_map.h"

#include <stddef.h>

#include "../base/elementary.h"
#include "../device/vibrating_load.h"
#include "../resolved/events.h"

/* Largest tolerance of LuGre friction in a map: differences of high order amplify its error. */
#define MAP_TOLERANCE 1e-10

int turns_of_period(const System *system, int max_turns, double near) {
    double ratio = system->device.normal_amplitude > 0.0 ? system->inputs.frequency_ratio : 0.0;
    return turns_to_repeat(ratio, max_turns, near);
}

static bool prepare_resolvent(PeriodMap *map, const Oscillator *slip) {
    Response free = free_response(slip, map->period);
    double a = free.displacement + slip->decay * free.rate - 1.0, b = free.rate;
    double c = -slip->stiffness * free.rate;
    double d = free.displacement - slip->decay * free.rate - 1.0;
    double determinant = a * d - b * c;
    map->resolvent[0][0] = d / determinant;
    map->resolvent[0][1] = -b / determinant;
    map->resolvent[1][0] = -c / determinant;
    map->resolvent[1][1] = a / determinant;
    return isfinite(1.0 / determinant);
}

static void prepare_fast_states(PeriodMap *map) {
    const System *system = &map->system;
    const Plant *plant = &system->plant;
    double w = plant->drive_frequency;
    double swing = complex_abs(map->system.fast.resonator);
    double moved = map->speed / w, felt = moved / fmax(plant->mass_fraction, EPSILON);
    map->scale[0] = fmin(swing > 0.0 ? swing : moved, felt);
    map->scale[1] = map->scale[0] * w;
    map->scale[2] = 1.0;
    map->fast_count = 2;
    map->kept = 0.0;
    map->decay = exp(-slower_decay(&plant->slip) * map->period);
    if (is_elastic(&system->bristle)) {
        double path = 4.0 * map->turns * map->speed / w;
        map->scale[2] = system->bristle.coefficient;
        map->fast_count = 3;
        map->kept = exp(-system->bristle.stiffness * path / system->bristle.coefficient);
        map->decay = fmax(map->decay, map->kept);
    }
}

bool period_map_prepare(PeriodMap *map, const System *system, int turns) {
    if (turns == 0 || !(system->fast.velocity > 0.0) || !system->plant.resolves_resonator) {
        return false;
    }
    map->system = *system;
    map->tolerance = system->device.tolerance;
    map->system.device.tolerance = fmin(system->device.tolerance, MAP_TOLERANCE);
    const Plant *plant = &map->system.plant;
    double waves = system->device.normal_amplitude > 0.0 ? turns * system->inputs.frequency_ratio : 0.0;
    map->turns = turns;
    map->drift = TAU * (waves - nearbyint(waves));
    map->period = TAU * turns / plant->drive_frequency;
    map->section = within_turn(map->system.fast.lag + PI);
    map->speed = map->system.fast.velocity;
    map->share = full_friction(&system->device) * map->period / (plant->total_mass * map->speed);
    prepare_fast_states(map);
    return map->decay < 1.0 && prepare_resolvent(map, &plant->slip);
}

double psi_after(const PeriodMap *map, double psi, double periods) {
    const Plant *plant = &map->system.plant;
    double t = periods * map->period;
    double chirp = 0.5 * plant->normal_rate * t * t;
    return within_turn(psi + remainder(map->drift * periods + chirp, TAU));
}

void moment_place(const PeriodMap *map, double velocity, const double fast[MAX_FAST], double psi, Moment *moment) {
    const System *system = &map->system;
    moment->theta = map->section;
    moment->psi = psi;
    moment->state.displacement = fast[0];
    moment->state.rate = fast[1];
    moment->bristle = fast[2];
    moment->state.velocity =
        velocity - map->system.fast.pair_velocity * cos(map->section) - system->plant.mass_fraction * fast[1];
    moment->mode = system->friction->mode(system, moment);
    moment->sliding = moment->mode == LIFTED ? STICK : moment->mode;
}

static SectionState section_state(const PeriodMap *map, const Moment *moment) {
    return (SectionState){{slow_velocity(&map->system, &moment->state, moment->theta), moment->state.displacement,
                           moment->state.rate, moment->bristle, moment->position, moment->reversals}};
}

bool map_periods(const PeriodMap *map, double begin, int count, Moment *moment, Budget *budget, SectionState *sections,
                 uint64_t *itinerary) {
    Refusal refusal;
    System later = system_after(&map->system, begin * map->period);
    Itinerary passed = {0, NO_MODE, false};
    sections[0] = section_state(map, moment);
    for (int k = 1; k <= count; k++) {
        Moment before = *moment;
        passed.counts_means = k > 1 && k + 1 >= count; /* in the last whole turn, as far as a sequence has one */
        if (!events_advance(&later, &before, map->period, NULL, &passed, budget, moment, &refusal)) {
            return false;
        }
        moment->theta = map->section;
        sections[k] = section_state(map, moment);
        if (is_ramped(&map->system.plant)) {
            later = system_after(&map->system, (begin + k) * map->period);
        }
    }
    *itinerary = passed.hash;
    double sum = 0.0;
    for (int k = 0; k < NUMBERS; k++) {
        sum += sections[count].at[k];
    }
    return isfinite(sum);
}

void apply_resolvent(const PeriodMap *map, int times, double fast[MAX_FAST]) {
    for (int i = 0; i < times; i++) {
        double displacement = fast[0], rate = fast[1];
        fast[0] = map->resolvent[0][0] * displacement + map->resolvent[0][1] * rate;
        fast[1] = map->resolvent[1][0] * displacement + map->resolvent[1][1] * rate;
        fast[2] /= map->kept - 1.0;
    }
}

double fast_size(const PeriodMap *map, const double fast[MAX_FAST]) {
    double largest = 0.0;
    for (int i = 0; i < map->fast_count; i++) {
        largest = fmax(largest, fabs(fast[i]) / map->scale[i]);
    }
    return largest;
}
