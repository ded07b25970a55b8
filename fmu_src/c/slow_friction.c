#include "slow_friction.h"

#include <math.h>

#include "averaged_lugre.h"
#include "state.h"

/* Distance of the frequency ratio from an integer up to which the phase counts as slow; under a
 * lifting contact that of q times the ratio, times q, for q of a few turns. */
#define NEAR 0.1

static FastMotion fast_motion(const Law *law) {
    FastMotion fast = {law->fast.velocity, law->device.drive_frequency};
    return fast;
}

/* Angle tau at which sliding turns forward [rad]; 0 or pi once it no longer turns. */
static double turning_at(double velocity, double fast_velocity) {
    if (fabs(velocity) >= fast_velocity) {
        return velocity > 0.0 ? 0.0 : PI;
    }
    return acos(velocity / fast_velocity);
}

static SlowForm form_of(const Law *law, int turns, double waves) {
    const Device *device = &law->device;
    bool lifts = device->normal_amplitude > device->normal_preload;
    bool in_phase = turns > 0 && waves != 0.0;
    /* Without vibration a slaved bristle is always fully bent, and its friction Coulomb's. */
    if (device->friction_law == 0 || law->fast.velocity == 0.0) {
        return in_phase && !lifts ? SLOW_COULOMB : SLOW_COULOMB_OVER_FLIGHT;
    }
    if (!in_phase) {
        return SLOW_LUGRE_UNDER_MEAN_LOAD;
    }
    return lifts || fabs(waves) > MOST_WAVES_TABULATED ? SLOW_LUGRE_OVER_FLIGHT : SLOW_LUGRE;
}

SlowFriction slow_friction_of(const Law *law, double theta, double psi) {
    const Device *device = &law->device;
    double ratio = law->inputs.frequency_ratio, n = ratio;
    double faces = device->friction_faces, mu = device->friction_coefficient;
    int turns = turns_to_repeat(device, ratio, NEAR);
    if (turns > 0) {
        n = nearbyint(turns * ratio) / turns;
    }
    SlowFriction friction = {.law = law, .form = form_of(law, turns, n)};
    friction.waves = n;
    friction.drift = (ratio - n) * device->drive_frequency;
    friction.phase = law->inputs.phase + psi - n * theta + n * law->fast.lag;
    friction.preload = faces * device->normal_preload;
    friction.swing = faces * device->normal_amplitude;
    if (friction.form == SLOW_COULOMB) {
        friction.preload = faces * mu * device->normal_preload;
        friction.swing = 2.0 * (faces * mu) * device->normal_amplitude / (n * PI);
        friction.sine = sin(friction.phase);
    } else if (friction.form == SLOW_LUGRE || friction.form == SLOW_LUGRE_UNDER_MEAN_LOAD) {
        FastMotion fast = fast_motion(law);
        double tabulated = friction.form == SLOW_LUGRE ? n : 1.0;
        friction.means = friction_table_of(law->table, &law->bristle, &fast, tabulated);
    }
    if (friction.form != SLOW_COULOMB && friction.form != SLOW_LUGRE) {
        friction.load = vibrating_load_of(device, friction.waves, friction.phase);
    }
    return friction;
}

static VibratingLoad load_at(const SlowFriction *friction, double t) {
    if (friction->drift == 0.0) {
        return friction->load;
    }
    double phase = friction->phase + friction->drift * t;
    return vibrating_load_of(&friction->law->device, friction->waves, phase);
}

static double coulomb_at(const SlowFriction *friction, double t, double turning) {
    double sine = friction->sine;
    if (friction->drift != 0.0) {
        sine = sin(friction->phase + friction->drift * t);
    }
    return friction->preload * (1.0 - 2.0 / PI * turning) -
           friction->swing * sin(friction->waves * turning) * sine;
}

static double lugre_at(const SlowFriction *friction, double t, double turning) {
    FrictionMeans means = tabulated_means_at(friction->means, turning);
    double delta = friction->phase + friction->drift * t;
    return friction->preload * means.plain +
           friction->swing * (cos(delta) * means.sine + sin(delta) * means.cosine);
}

double slow_friction_at(const SlowFriction *friction, double t, double velocity) {
    const Law *law = friction->law;
    double turning = turning_at(velocity, law->fast.velocity), faces = law->device.friction_faces;
    if (friction->form == SLOW_COULOMB) {
        return coulomb_at(friction, t, turning);
    }
    if (friction->form == SLOW_LUGRE) {
        return lugre_at(friction, t, turning);
    }
    VibratingLoad load = load_at(friction, t);
    if (friction->form == SLOW_COULOMB_OVER_FLIGHT) {
        double scale = faces * law->device.friction_coefficient / TAU;
        return scale * vibrating_load_difference(&load, turning);
    }
    if (friction->form == SLOW_LUGRE_UNDER_MEAN_LOAD) {
        double mean = faces / TAU * (load.constant * TAU);
        return mean * tabulated_means_at(friction->means, turning).plain;
    }
    FastMotion fast = fast_motion(law);
    return faces * mean_friction(&law->bristle, &fast, &load, turning);
}
