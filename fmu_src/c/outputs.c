#include "outputs.h"

#include <stddef.h>

#include "elementary.h"
#include "fast_vibration.h"
#include "prediction.h"
#include "slow_phase.h"
#include "state.h"
#include "variables.h"
#include "vibrating_load.h"

/* Displacement [m] and velocity [m/s] of the resonator. */
static Response resonator_swing(const Law *law, const Moment *moment) {
    const Plant *plant = &law->held.plant;
    if (plant->resolves_resonator || moment->orbit.stage != AVERAGED) {
        return (Response){moment->state.displacement, moment->state.rate};
    }
    return steady_swing(plant->resonator_amplitude, moment->theta, plant->drive_frequency);
}

static double normal_force(const Law *law, const Moment *moment) {
    double chi = moment->psi + law->inputs.phase;
    double force = law->device.normal_preload + law->device.normal_amplitude * sin(chi);
    return force > 0.0 ? force : 0.0;
}

static double stick_fraction(const Law *law, const Moment *moment) {
    return period_stick_fraction(&moment->means, law_mode(law, moment) == STICK);
}

/* psi - n theta in [-pi, pi] [rad]; 0 where the load never repeats. */
static double normal_lead(const Law *law, const Moment *moment) {
    double ratio = law->inputs.frequency_ratio;
    if (turns_to_repeat(&law->device, ratio, EXACT) == 0) {
        return 0.0;
    }
    return rounded_lead(remainder(moment->psi - ratio * moment->theta, TAU));
}

static const Averaged *theory_of(const Law *law, const Moment *moment, Theory *theory) {
    double lead = normal_lead(law, moment);
    if (!theory->known || theory->normal_lead != lead) {
        theory->averaged = prediction_of(law, lead);
        theory->normal_lead = lead;
        theory->known = true;
    }
    return &theory->averaged;
}

double output_value(unsigned reference, const Law *law, const Moment *moment,
                    double last_event_time, Theory *theory) {
    switch (reference) {
    case VR_POSITION:
        return moment->position;
    case VR_VELOCITY:
        return moment->state.velocity;
    case VR_MEAN_VELOCITY:
        return period_mean_velocity(&moment->means, moment->state.velocity);
    case VR_RESONATOR_DISPLACEMENT:
        return resonator_swing(law, moment).displacement;
    case VR_RESONATOR_VELOCITY:
        return resonator_swing(law, moment).rate;
    case VR_NORMAL_FORCE:
        return normal_force(law, moment);
    case VR_FRICTION_FORCE:
        return law_friction_force(law, moment, law_mode(law, moment));
    case VR_CONTACT_MODE:
        return law_mode(law, moment);
    case VR_REVERSALS:
        return moment->counts.reversals;
    case VR_STICK_FRACTION:
        return stick_fraction(law, moment);
    case VR_LAST_EVENT_TIME:
        return last_event_time;
    case VR_STEADY_VELOCITY:
        return theory_of(law, moment, theory)->steady_velocity;
    case VR_BLOCKING_FORCE:
        return theory_of(law, moment, theory)->blocking_force;
    case VR_PREDICTION_VALID:
        return theory_of(law, moment, theory)->valid ? 1.0 : 0.0;
    case VR_SLOW_MOTION_ERROR:
        return law_slow_motion_error(law, moment);
    }
    return NAN; /* no output has this reference */
}
