#include "period_map.h"

#include <stddef.h>

#include "angle.h"
#include "contact.h"
#include "elementary.h"
#include "events.h"
#include "friction_law.h"
#include "state.h"
#include "vibrating_load.h"

bool period_map_prepare(PeriodMap *map, const Device *device, double ratio, int turns,
                        Refusal *refusal) {
    Device full = *device;
    Inputs inputs = {.frequency_ratio = ratio};
    full.fidelity = 2;
    full.tolerance = fmin(device->tolerance, MAP_TOLERANCE);
    if (!law_prepare(&map->law, &full, &inputs, NULL, refusal) ||
        !fast_vibration_prepare(&map->fast, &full, refusal)) {
        return false;
    }
    const Held *held = &map->law.held;
    double w = held->plant.drive_frequency;
    map->turns = turns;
    map->states = full.friction_law == 0 ? 3 : 4;
    map->period = TAU * turns / w;
    map->speed = map->fast.velocity;
    map->swing = complex_abs(map->fast.resonator);
    if (!(map->swing > 0.0)) {
        map->swing = map->speed / w;
    }
    map->force = held->plant.total_mass * map->speed / map->period;
    return true;
}

double section_phase(const PeriodMap *map, int direction) {
    return within_turn(map->fast.lag + (direction > 0 ? PI : 0.0));
}

double momentum_velocity(const PeriodMap *map, const State *state, double theta) {
    return state->velocity + map->law.held.plant.mass_fraction * state->rate +
           map->fast.pair_velocity * cos(theta);
}

/* The law with the phase and the load of an orbit. */
static Law law_under(const PeriodMap *map, double lead, double load) {
    Law law = map->law;
    law.inputs.phase = law.held.plant.phase = lead;
    law.inputs.load = law.held.plant.load = load;
    return law;
}

void orbit_enter(const PeriodMap *map, double lead, double theta, Moment *moment) {
    Law law = law_under(map, lead, 0.0);
    moment->position = 0.0;
    moment->theta = theta;
    moment->psi = within_turn(map->law.inputs.frequency_ratio * theta);
    moment->event_age = INFINITY;
    moment->means = (PeriodMeans){0};
    moment->counts = (Counts){0};
    moment->mode = law_mode(&law, moment);
    moment->counts.sliding = moment->mode == LIFTED ? STICK : moment->mode;
}

static bool is_finite(const Moment *moment) {
    return isfinite(moment->position + moment->state.velocity + moment->state.displacement +
                    moment->state.rate + moment->bristle);
}

bool orbit_advance(const PeriodMap *map, double lead, double load, const Moment *moment,
                   double duration, Moment *after) {
    Law law = law_under(map, lead, load);
    Budget budget = budget_of(duration);
    Refusal refusal;
    return events_advance(&law, moment, duration, NULL, &budget, after, &refusal) && is_finite(after);
}

bool orbit_trace(const PeriodMap *map, double lead, double load, const Moment *moment,
                 double duration, Trace *trace, Moment *after) {
    Law law = law_under(map, lead, load);
    Budget budget = budget_of(duration);
    Refusal refusal;
    return events_trace(&law, moment, duration, trace, &budget, after, &refusal) && is_finite(after);
}

double sliding_friction(const PeriodMap *map, double lead) {
    const Device *device = &map->law.device;
    VibratingLoad load = vibrating_load_of(device, map->law.inputs.frequency_ratio, lead);
    double mean = load.is_constant ? load.constant : load.per_turn / TAU;
    return device->friction_faces * device->friction_coefficient * mean;
}
