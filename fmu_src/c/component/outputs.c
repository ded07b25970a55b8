#include "outputs.h"

#include "../base/elementary.h"
#include "../leap/period_map.h"
#include "../resolved/motion.h"
#include "variables.h"

/* Displacement [m] and velocity [m/s] of the resonator. */
static Response resonator_swing(const System *system, const Moment *moment) {
    const Plant *plant = &system->plant;
    if (plant->resolves_resonator) {
        return (Response){moment->state.displacement, moment->state.rate};
    }
    return steady_swing(system->fast.resonator, moment->theta, plant->drive_frequency);
}

static double normal_force(const System *system, const Moment *moment) {
    double chi = moment->psi + system->inputs.phase;
    double force = system->device.normal_preload + system->device.normal_amplitude * sin(chi);
    return force > 0.0 ? force : 0.0;
}

/* Parts of a radian to which leads of the normal load are rounded: inputs that return to earlier values find their
 * prediction in spite of rounding errors of phases. */
#define LEAD_PARTS 1e12

/* psi - n theta [rad], the same in all turns of the load; 0 where it never repeats. */
static double normal_lead(const System *system, const Moment *moment) {
    int turns = turns_of_period(system, MAX_TURNS_OF_LOAD, 0.0);
    if (turns == 0) {
        return 0.0;
    }
    double lead = moment->psi - system->inputs.frequency_ratio * moment->theta;
    return nearbyint(remainder(lead, TAU / turns) * LEAD_PARTS) / LEAD_PARTS;
}

static Prediction predict(const System *system, const Moment *moment, Theory *theory, Quantity quantity) {
    double lead = normal_lead(system, moment);
    if (theory->normal_lead != lead) {
        *theory = (Theory){.normal_lead = lead};
    }
    if (!theory->known[quantity]) {
        theory->predictions[quantity] = prediction_of(system, lead, quantity);
        theory->known[quantity] = true;
    }
    return theory->predictions[quantity];
}

double output_value(unsigned reference, const System *system, const Moment *moment, double last_event_time,
                    Theory *theory) {
    switch (reference) {
    case VR_POSITION:
        return moment->position;
    case VR_VELOCITY:
        return moment->state.velocity;
    case VR_MEAN_VELOCITY:
        return period_mean_velocity(&moment->means, moment->state.velocity);
    case VR_RESONATOR_DISPLACEMENT:
        return resonator_swing(system, moment).displacement;
    case VR_RESONATOR_VELOCITY:
        return resonator_swing(system, moment).rate;
    case VR_NORMAL_FORCE:
        return normal_force(system, moment);
    case VR_FRICTION_FORCE:
        return system->motion->force(system, moment, system->motion->mode(system, moment));
    case VR_CONTACT_MODE:
        return system->motion->mode(system, moment);
    case VR_REVERSALS:
        return moment->reversals;
    case VR_STICK_FRACTION:
        return period_stick_fraction(&moment->means, system->motion->mode(system, moment) == STICK);
    case VR_LAST_EVENT_TIME:
        return last_event_time;
    case VR_STEADY_VELOCITY:
        return predict(system, moment, theory, STEADY_VELOCITY).value;
    case VR_BLOCKING_FORCE:
        return predict(system, moment, theory, BLOCKING_FORCE).value;
    case VR_PREDICTION_VALID:
        return predict(system, moment, theory, STEADY_VELOCITY).valid &&
               predict(system, moment, theory, BLOCKING_FORCE).valid;
    case VR_FRICTION_POWER:
        return system->motion->power(system, moment);
    case VR_SLOW_MOTION_ERROR:
        return system->motion->error(system, moment);
    }
    return NAN; /* no output has this reference */
}

static double normal_force_rate(const System *system, const Moment *moment, double phase_rate) {
    double chi = moment->psi + system->inputs.phase, amplitude = system->device.normal_amplitude;
    double frequency = system->plant.normal_frequency + phase_rate;
    bool touches = system->device.normal_preload + amplitude * sin(chi) > 0.0;
    return touches ? amplitude * cos(chi) * frequency : 0.0;
}

bool output_derivative(unsigned reference, const System *system, const Moment *moment, double phase_rate,
                       double *derivative, Refusal *refusal) {
    Rates rates = system->motion->rates(system, moment);
    const double known[VARIABLE_COUNT] = {
        [VR_POSITION] = moment->state.velocity,
        [VR_VELOCITY] = rates.state.velocity,
        [VR_RESONATOR_DISPLACEMENT] = rates.state.displacement,
        [VR_RESONATOR_VELOCITY] = rates.state.rate,
        [VR_NORMAL_FORCE] = normal_force_rate(system, moment, phase_rate),
        [VR_MEAN_VELOCITY] = rates.mean_velocity,
    };
    bool unknown = reference == VR_FRICTION_FORCE || reference == VR_FRICTION_POWER ||
                   reference == VR_STEADY_VELOCITY || reference == VR_BLOCKING_FORCE ||
                   reference == VR_SLOW_MOTION_ERROR;
    *derivative = known[reference];
    return (reference >= SETTABLE_COUNT && !unknown) ||
           refuse(refusal, "derivative of %s refused: %s", VARIABLES[reference].name,
                  unknown ? "this FMU does not provide it" : "it is no output");
}
