#include "orbit_drift.h"

#include "elementary.h"
#include "state.h"

/* Adds a rate times `amount` to the section. */
static void shift_section(const PeriodMap *map, const SectionRate *rate, double amount,
                          Moment *section) {
    section->state.velocity += amount * rate->state.velocity;
    section->state.displacement += amount * rate->state.displacement;
    section->state.rate += amount * rate->state.rate;
    if (map->states > 3) {
        section->bristle += amount * rate->bristle;
    }
}

bool held_orbit_moment(const PeriodMap *map, const HeldOrbit *orbit, double load, double theta,
                       Moment *moment) {
    const Plant *plant = &map->law.held.plant;
    double turned = theta - orbit->section.theta, turns = TAU * map->turns;
    double since = (turned - turns * floor(turned / turns)) / plant->drive_frequency;
    double excess = orbit->linearised && !orbit->sticks ? load + orbit->friction : 0.0;
    /* V and the excess decay at one rate: to second order in time what they were at the section. */
    double slowed = orbit->factor * excess / plant->total_mass;
    double decay = orbit->factor * orbit->slope / plant->total_mass * since;
    Moment section = orbit->section;
    shift_section(map, &orbit->tangent, slowed * since * (1.0 + decay / 2.0 + decay * decay / 6.0),
                  &section);
    shift_section(map, &orbit->lag, excess * exp(decay), &section);
    orbit_enter(map, orbit->lead, orbit->section.theta, &section);
    *moment = section;
    if (since > 0.0 && !orbit_advance(map, orbit->lead, excess - orbit->friction, &section, since,
                                      moment)) {
        return false;
    }
    moment->position -= (orbit->velocity + 0.5 * slowed * since * (1.0 + decay / 3.0)) * since;
    return true;
}

double held_orbit_offset(const PeriodMap *map, const HeldOrbit *orbit, const Moment *moment) {
    return momentum_velocity(map, &moment->state, moment->theta) - orbit->velocity;
}
