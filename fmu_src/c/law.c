#include "law.h"

#include <math.h>
#include <stddef.h>

#include "events.h"
#include "friction_law.h"
#include "orbit_motion.h"
#include "slow_motion.h"
#include "slow_motion_error.h"

static bool is_averaged(const Device *device) {
    return device->fidelity == 0;
}

/* The law that a moment belongs to: along orbits that of the full device. */
static const Law *law_of_moment(const Law *law) {
    return law->resolved != NULL ? law->resolved : law;
}

bool law_prepare(Law *law, const Device *device, const Inputs *inputs, FrictionTable *table,
                 Refusal *refusal) {
    law->device = *device;
    law->inputs = *inputs;
    law->middle_ratio = inputs->frequency_ratio;
    law->bristle = bristle_of(device);
    law->table = table;
    law->resolved = NULL;
    law->orbits = NULL;
    law->bending = NULL;
    law->friction = friction_law_of(device->friction_law);
    if (law->friction == NULL) {
        return refuse(refusal, "friction_law = %d refused: no law has this number",
                      device->friction_law);
    }
    return law->friction->check(device, refusal) &&
           held_prepare(&law->held, device, inputs, refusal) &&
           (!is_averaged(device) || fast_vibration_prepare(&law->fast, device, refusal));
}

void law_change(Law *law, double phase, double load) {
    law->inputs.phase = law->held.plant.phase = phase;
    law->inputs.load = law->held.plant.load = load;
}

void law_ramp(Law *law, const Ramp *ramp, double duration) {
    double w = law->held.plant.drive_frequency;
    law->inputs.frequency_ratio = ramp->ratio;
    law->held.plant.normal_frequency = ramp->ratio * w;
    held_ramp(&law->held, ramp->load_rate, ramp->ratio_rate * w, duration);
}

Law law_after(const Law *law, double t) {
    Law later = *law;
    Plant *plant = &later.held.plant;
    double passed = plant->normal_rate / plant->drive_frequency * t;
    plant->normal_frequency += plant->normal_rate * t;
    later.inputs.frequency_ratio += passed;
    later.middle_ratio += 0.5 * passed;
    later.inputs.load += plant->load_rate * t;
    plant->load = later.inputs.load;
    return later;
}

SlowPhase law_slow_phase(const Law *law) {
    double chirp = law->held.plant.normal_rate;
    return chirp != 0.0 ? slow_phase_chirped(&law->device, law->inputs.frequency_ratio,
                                             law->middle_ratio, chirp)
                        : slow_phase_of(&law->device, law->inputs.frequency_ratio);
}

bool law_follows_orbits(const Law *law) {
    const Device *device = &law->device;
    return is_averaged(device) && device->averaging_order == 2 && has_slow_motion(law);
}

/* Velocity [m/s] at the start. A resonator that is not resolved vibrates steadily at once; the velocity is
 * chosen so that the momentum of the pair is that of the initial values. In averaged motion the first step
 * does so. */
static double start_velocity(const Law *law) {
    const Device *device = &law->device;
    const Plant *plant = &law->held.plant;
    if (is_averaged(device) || plant->resolves_resonator) {
        return device->initial_velocity;
    }
    double rate = steady_swing(plant->resonator_amplitude, 0.0, plant->drive_frequency).rate;
    return device->initial_velocity
           + device_mass_fraction(device) * (device->initial_resonator_velocity - rate);
}

Moment law_start(const Law *law) {
    const Device *device = &law->device;
    if (law->resolved != NULL) {
        Moment first = law_start(law->resolved);
        first.orbit = orbit_motion_start(law, &first);
        return first;
    }
    Moment first = {.position = device->initial_position, .event_age = INFINITY};
    first.state.velocity = start_velocity(law);
    first.state.displacement = device->initial_resonator_displacement;
    first.state.rate = device->initial_resonator_velocity;
    first.mode = law_mode(law, &first);
    if (is_averaged(device)) {
        first.means.complete = true;
        first.means.mean_velocity = slow_velocity(law, &first.state, first.theta);
    } else {
        first.bristle = law->friction->first_bristle(law);
    }
    return first;
}

bool law_advance(const Law *law, const Moment *moment, double duration, EventSearch *search,
                 Budget *budget, Moment *after, Refusal *refusal) {
    if (law->resolved != NULL) {
        return orbit_motion_advance(law, moment, duration, search, budget, after, refusal);
    }
    return is_averaged(&law->device)
               ? slow_advance(law, moment, duration, budget, after, refusal)
               : events_advance(law, moment, duration, search, budget, after, refusal);
}

int law_mode(const Law *any, const Moment *moment) {
    const Law *law = law_of_moment(any);
    return is_averaged(&law->device) ? slow_mode(law, moment) : law->friction->mode(law, moment);
}

double law_friction_force(const Law *any, const Moment *moment, int mode) {
    const Law *law = law_of_moment(any);
    return is_averaged(&law->device) ? slow_friction_force(law, moment)
                                     : law->friction->force(law, moment, mode);
}

void law_settle_error(const Law *law, Moment *moment) {
    if (law->resolved != NULL) {
        orbit_motion_settle(law, moment);
    }
}

double law_slow_motion_error(const Law *law, const Moment *moment) {
    if (!is_averaged(&law->device)) {
        return 0.0;
    }
    return law->resolved != NULL ? orbit_motion_error(law, moment) : first_order_error(law);
}
