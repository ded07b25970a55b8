#include "output_derivatives.h"

#include <stddef.h>

#include "../base/elementary.h"
#include "../resolved/motion.h"
#include "variables.h"

static double normal_force_rate(const Law *law, const Moment *moment, double phase_rate) {
    double chi = moment->psi + law->inputs.phase, amplitude = law->device.normal_amplitude;
    double frequency = law->held.plant.normal_frequency + phase_rate;
    bool touches = law->device.normal_preload + amplitude * sin(chi) > 0.0;
    return touches ? amplitude * cos(chi) * frequency : 0.0;
}

bool output_derivative(unsigned reference, const Law *law, const Moment *moment, double phase_rate,
                       double *derivative, Refusal *refusal) {
    Rates rates = law->motion->rates(law, moment);
    switch (reference) {
    case VR_POSITION:
        *derivative = moment->state.velocity;
        return true;
    case VR_VELOCITY:
        *derivative = rates.state.velocity;
        return true;
    case VR_RESONATOR_DISPLACEMENT:
        *derivative = rates.state.displacement;
        return true;
    case VR_RESONATOR_VELOCITY:
        *derivative = rates.state.rate;
        return true;
    case VR_NORMAL_FORCE:
        *derivative = normal_force_rate(law, moment, phase_rate);
        return true;
    case VR_MEAN_VELOCITY:
        *derivative = rates.mean_velocity;
        return true;
    case VR_CONTACT_MODE:
    case VR_REVERSALS:
    case VR_STICK_FRACTION:
    case VR_LAST_EVENT_TIME:
    case VR_PREDICTION_VALID:
        *derivative = 0.0;
        return true;
    case VR_FRICTION_FORCE:
    case VR_STEADY_VELOCITY:
    case VR_BLOCKING_FORCE:
    case VR_SLOW_MOTION_ERROR:
        return refuse(refusal, "derivative of %s refused: this FMU does not provide it",
                      VARIABLES[reference].name);
    }
    return refuse(refusal, "derivative of %s refused: it is no output", VARIABLES[reference].name);
}
