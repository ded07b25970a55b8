/* Resolved motion, event by event: fidelity 1 and 2. */
#include <stddef.h>

#include "../base/constants.h"
#include "../base/elementary.h"
#include "motion.h"

/* A resonator that is not resolved vibrates steadily at once; the velocity is chosen so that the momentum of the pair
 * is that of the initial values. */
Moment resolved_start(const System *system) {
    const Device *device = &system->device;
    const Plant *plant = &system->plant;
    Moment first = first_moment(device);
    if (!plant->resolves_resonator) {
        double rate = steady_swing(system->fast.resonator, 0.0, plant->drive_frequency).rate;
        first.state.velocity += device_mass_fraction(device) * (first.state.rate - rate);
    }
    first.mode = system->friction->mode(system, &first);
    first.bristle = bristle_bent(&system->bristle, device->initial_bristle_deflection);
    return first;
}

/* Refuses a motion that spans too many turns of the fastest oscillation. */
static bool resolved_advance(const System *system, const Moment *moment, double duration, EventSearch *search,
                             Budget *budget, Moment *after, Refusal *refusal) {
    double frequency = LONGEST_ARC / system->arc;
    if (duration * frequency > TAU * MAX_TURNS) {
        return refuse_too_many_turns(refusal, budget->step_size, frequency, MAX_TURNS);
    }
    return events_advance(system, moment, duration, search, NULL, budget, after, refusal);
}

int resolved_mode(const System *system, const Moment *moment) {
    return system->friction->mode(system, moment);
}

double resolved_force(const System *system, const Moment *moment, int mode) {
    return system->friction->force(system, moment, mode);
}

double resolved_power(const System *system, const Moment *moment) {
    double force = resolved_force(system, moment, resolved_mode(system, moment));
    return period_friction_power(&moment->means, force * moment->state.velocity);
}

/* The equations of motion (26)-(27). */
Rates resolved_rates(const System *system, const Moment *moment) {
    const Plant *plant = &system->plant;
    double w = plant->drive_frequency, sine = sin(moment->theta), cosine = cos(moment->theta);
    State rates = {.displacement = moment->state.rate};
    int mode = system->friction->mode(system, moment);
    if (mode != STICK || is_elastic(&system->bristle)) {
        double force = plant->holding_drive.re * sine + plant->holding_drive.im * cosine - plant->load -
                       system->friction->force(system, moment, mode);
        force += plant->spring * moment->state.displacement + plant->damper * moment->state.rate;
        rates.velocity = force / plant->slider_mass;
    }
    if (plant->resolves_resonator) {
        rates.rate = plant->base_acceleration * sine - 2.0 * plant->stick.decay * moment->state.rate -
                     plant->stick.stiffness * moment->state.displacement - rates.velocity;
    } else {
        Response swing = steady_swing(system->fast.resonator, moment->theta, w);
        rates.displacement = swing.rate;
        rates.rate = -w * w * swing.displacement;
    }
    return (Rates){rates, 0.0};
}

double resolved_error(const System *system, const Moment *moment) {
    (void)system;
    return moment->leap_error;
}

const Motion RESOLVED_MOTION = {
    .start = resolved_start,
    .advance = resolved_advance,
    .mode = resolved_mode,
    .force = resolved_force,
    .power = resolved_power,
    .rates = resolved_rates,
    .error = resolved_error,
};
