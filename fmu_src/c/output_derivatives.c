#include "output_derivatives.h"

#include <stddef.h>

#include "elementary.h"
#include "fast_vibration.h"
#include "friction_law.h"
#include "variables.h"

/* Accelerations of the slider, and of the resonator relative to it [m/s^2]; displacement and rate of the
 * resonator [m, m/s]. */
typedef struct {
    double slider, resonator;
    Response swing;
} Motion;

/* Averaged motion of first order: the slow acceleration, and the steady vibration. */
static double slow_acceleration(const Law *law, const Moment *moment) {
    double friction = law_friction_force(law, moment, law_mode(law, moment));
    return -(friction + law->inputs.load) / law->held.plant.total_mass;
}

static Motion averaged_motion(const Law *law, const Moment *moment) {
    double w = law->held.plant.drive_frequency, share = device_mass_fraction(&law->device);
    Motion motion = {.swing = steady_swing(law->fast.resonator, moment->theta, w)};
    motion.resonator = -w * w * motion.swing.displacement;
    motion.slider = slow_acceleration(law, moment) +
                    law->fast.pair_velocity * w * sin(moment->theta) - share * motion.resonator;
    return motion;
}

/* The equations of motion (26)-(27), of the full device along orbits. */
static Motion resolved_motion(const Law *law, const Moment *moment) {
    const Plant *plant = law->resolved != NULL ? &law->resolved->held.plant : &law->held.plant;
    double w = plant->drive_frequency, sine = sin(moment->theta), cosine = cos(moment->theta);
    Motion motion = {.swing = {moment->state.displacement, moment->state.rate}};
    int mode = law_mode(law, moment);
    if (mode != STICK || !law->friction->sticks) {
        double force = plant->holding_drive.re * sine + plant->holding_drive.im * cosine -
                       plant->load - law_friction_force(law, moment, mode);
        force += plant->spring * motion.swing.displacement + plant->damper * motion.swing.rate;
        motion.slider = force / plant->slider_mass;
    }
    if (plant->resolves_resonator) {
        motion.resonator = plant->base_acceleration * sine -
                           2.0 * plant->stick.decay * motion.swing.rate -
                           plant->stick.stiffness * motion.swing.displacement - motion.slider;
    } else {
        motion.swing = steady_swing(plant->resonator_amplitude, moment->theta, w);
        motion.resonator = -w * w * motion.swing.displacement;
    }
    return motion;
}

static bool is_averaged(const Law *law) {
    return law->device.fidelity == 0 && law->resolved == NULL;
}

static double normal_force_rate(const Law *law, const Moment *moment, double phase_rate) {
    double chi = moment->psi + law->inputs.phase, amplitude = law->device.normal_amplitude;
    double frequency = law->held.plant.normal_frequency + phase_rate;
    bool touches = law->device.normal_preload + amplitude * sin(chi) > 0.0;
    return touches ? amplitude * cos(chi) * frequency : 0.0;
}

bool output_derivative(unsigned reference, const Law *law, const Moment *moment, double phase_rate,
                       double *derivative, Refusal *refusal) {
    Motion motion = is_averaged(law) ? averaged_motion(law, moment) : resolved_motion(law, moment);
    switch (reference) {
    case VR_POSITION:
        *derivative = moment->state.velocity;
        return true;
    case VR_VELOCITY:
        *derivative = motion.slider;
        return true;
    case VR_RESONATOR_DISPLACEMENT:
        *derivative = motion.swing.rate;
        return true;
    case VR_RESONATOR_VELOCITY:
        *derivative = motion.resonator;
        return true;
    case VR_NORMAL_FORCE:
        *derivative = normal_force_rate(law, moment, phase_rate);
        return true;
    case VR_MEAN_VELOCITY:
        *derivative = is_averaged(law) ? slow_acceleration(law, moment) : 0.0;
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
