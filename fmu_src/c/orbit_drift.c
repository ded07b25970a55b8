#include "orbit_drift.h"

#include "elementary.h"
#include "state.h"

/* Error of slow motion over the square of the change of V in a period, both in v_q: with the root
 * of the waves of the normal load in a turn of the drive, one at least; with the periods that the
 * resonator remembers; with the added mass over the total one; and in flight, for the kinks of its
 * curves, with that change of V. Fitted to transients of random devices with a friction share up to
 * 0.1. */
#define ERROR_OF_WAVES 0.012
#define ERROR_OF_MEMORY 0.0025
#define ERROR_OF_ADDED_MASS 2.5
#define ERROR_OF_FLIGHT 0.2

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

/* Periods that the resonator remembers, the present one included. */
static double memory(const PeriodMap *map) {
    const Oscillator *slip = &map->law.held.plant.slip;
    double excess = slip->decay * slip->decay - slip->stiffness;
    double slowest = excess > 0.0 ? slip->stiffness / (slip->decay + sqrt(excess)) : slip->decay;
    return -1.0 / expm1(-slowest * map->period);
}

double drift_error(const PeriodMap *map, double factor, double excess) {
    const Device *device = &map->law.device;
    double waves = fmax(1.0, fabs(map->law.inputs.frequency_ratio));
    double change = fabs(factor * excess) / map->force;
    double share = ERROR_OF_WAVES * sqrt(waves) + ERROR_OF_MEMORY * memory(map) +
                   ERROR_OF_ADDED_MASS * fabs(factor - 1.0);
    if (device->normal_amplitude > device->normal_preload) {
        share += ERROR_OF_FLIGHT * change;
    }
    return map->speed * fmin(1.0, share * change * change);
}
