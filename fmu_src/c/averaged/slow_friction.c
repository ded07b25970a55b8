#include "slow_friction.h"

#include "../base/elementary.h"
#include "../device/state.h"
#include "../friction/friction_law.h"
#include "slow_phase.h"

/* Angle tau at which sliding turns forward [rad]; 0 or pi where it never reverses. */
static double turning_at(double velocity, double fast_velocity) {
    if (fabs(velocity) >= fast_velocity) {
        return velocity > 0.0 ? 0.0 : PI;
    }
    return acos(velocity / fast_velocity);
}

static SlowForm form_of(const Law *law, const AveragedFriction *friction, int turns,
                        double waves) {
    const Device *device = &law->device;
    bool lifts = device->normal_amplitude > device->normal_preload;
    if (turns == 0 || waves == 0.0) {
        return UNDER_MEAN_LOAD;
    }
    bool too_many = friction->is_expensive && fabs(waves) > MAX_WAVES_TABULATED;
    return lifts || too_many ? UNDER_ANY_LOAD : UNDER_SINE;
}

/* Whether the load counts as constant in averages while its frequency grows. */
static bool is_steady_in_chirp(const SlowFriction *slow) {
    bool averaged = slow->form == UNDER_MEAN_LOAD && !slow->stands;
    return slow->slow.chirp != 0.0 && (averaged || slow->law->device.normal_amplitude == 0.0);
}

SlowFriction slow_friction_of(const Law *law, double theta, double psi) {
    const Device *device = &law->device;
    double chirp = law->held.plant.normal_rate, ratio = law->inputs.frequency_ratio;
    SlowPhase phase = chirp != 0.0
                          ? slow_phase_chirped(device, ratio, law->middle_ratio, chirp)
                          : slow_phase_of(device, ratio);
    double n = phase.waves;
    SlowFriction slow = {.law = law, .friction = law->friction->averaged};
    if (law->fast.velocity == 0.0) {
        /* Without vibration a bristle is always fully bent: friction is Coulomb's. */
        slow.friction = &AVERAGED_COULOMB;
    }
    slow.form = form_of(law, slow.friction, phase.turns, n);
    slow.fast = (FastMotion){law->fast.velocity, device->drive_frequency};
    slow.waves = n;
    slow.slow = phase;
    slow.beat = slow_phase_beat(&phase);
    slow.stands = n == 0.0;
    slow.phase = law->inputs.phase + psi - n * theta + n * law->fast.lag;
    if (slow.form == UNDER_SINE) {
        slow.sine = sin(slow.phase);
        slow.cosine = cos(slow.phase);
    } else {
        slow.load = vibrating_load_of(device, n, slow.phase);
    }
    if (is_steady_in_chirp(&slow)) {
        /* The frequency ratio may begin at an integer, where the load would count with its phase. */
        slow.load = slow.stands ? slow.load : vibrating_load_flattened(&slow.load);
        slow.slow.drift = slow.slow.chirp = slow.slow.fastest = 0.0;
        slow.beat = INFINITY;
    }
    slow.tabulated = slow.form != UNDER_ANY_LOAD && slow.friction->is_expensive;
    return slow;
}

static FrictionMeans means_at(const SlowFriction *slow, double turning) {
    const Bristle *bristle = &slow->law->bristle;
    double n = slow->form == UNDER_SINE ? slow->waves : 1.0;
    if (slow->tabulated) {
        FrictionTable *tables = slow->law->table;
        return tabulated_means_at(friction_table_of(tables, slow->friction, bristle, &slow->fast, n), turning);
    }
    return slow->friction->means(bristle, &slow->fast, n, turning);
}

/* Mean friction [N] of one face under a sine. */
static double under_sine(const SlowFriction *slow, double t, double turning) {
    const Device *device = &slow->law->device;
    FrictionMeans means = means_at(slow, turning);
    double sine = slow->sine, cosine = slow->cosine;
    if (slow_phase_drifts(&slow->slow)) {
        double phase = slow->phase + slow_phase_gain(&slow->slow, t);
        sine = sin(phase);
        cosine = cos(phase);
    }
    return device->normal_preload * means.plain +
           device->normal_amplitude * (cosine * means.sine + sine * means.cosine);
}

/* The same under a load of any shape. */
static double under_load(const SlowFriction *slow, double t, double turning) {
    VibratingLoad load = slow->load;
    if (slow_phase_drifts(&slow->slow)) {
        double phase = slow->phase + slow_phase_gain(&slow->slow, t);
        load = vibrating_load_of(&slow->law->device, slow->waves, phase);
    }
    if (slow->form == UNDER_MEAN_LOAD) {
        return load.constant * means_at(slow, turning).plain;
    }
    return slow->friction->mean(&slow->law->bristle, &slow->fast, &load, turning);
}

double slow_friction_to_kink(const SlowFriction *slow, double t) {
    if (!slow->stands) {
        return INFINITY;
    }
    const FlightWindow *window = &slow->law->held.window;
    double chi = slow->phase + slow_phase_gain(&slow->slow, t);
    double chirp = slow->slow.chirp, drift = slow->slow.drift + chirp * t;
    double going = drift != 0.0 ? drift : chirp;
    return time_to_switch_chirped(window, chi, drift, chirp, is_lifted(window, chi, going));
}

double slow_friction_sway(const SlowFriction *slow) {
    const Device *device = &slow->law->device;
    double amplitude = device->friction_faces * device->friction_coefficient * device->normal_amplitude;
    return slow->stands ? amplitude * slow->slow.fastest : 0.0;
}

double slow_friction_at(const SlowFriction *slow, double t, double velocity) {
    double turning = turning_at(velocity, slow->fast.velocity);
    double face = slow->form == UNDER_SINE ? under_sine(slow, t, turning)
                                           : under_load(slow, t, turning);
    return slow->law->device.friction_faces * face;
}
