#include "slow_friction.h"

#include "../base/elementary.h"

/* Largest distance of the frequency ratio from an integer at which the phase counts as slow. Under a lifting contact:
 * largest distance of q times the ratio, times q, for q up to a few turns. */
#define NEAR 0.1

double next_slow_boundary(const Device *device, double ratio, double direction) {
    double next = INFINITY, from = direction * ratio;
    for (int turns = 1; turns <= max_turns_to_repeat(device); turns++) {
        double near = NEAR / turns, waves = turns * from;
        for (int side = -1; side <= 1; side += 2) {
            double offset = side * near;
            double boundary = (floor(waves - offset) + 1.0 + offset) / turns;
            next = fmin(next, boundary);
        }
    }
    return direction * next;
}

/* The table of means, where one pays: for a load whose phase enters by sine and cosine alone, or not at all. */
static const FrictionTable *table_of(const SlowFriction *slow) {
    const VibratingLoad *load = &slow->load;
    bool is_sine = !vibrating_load_lifts(load) && fabs(load->ratio) <= MAX_WAVES_TABULATED;
    if (!is_elastic(&slow->bristle) || !(load->is_constant || is_sine)) {
        return NULL;
    }
    double waves = load->is_constant ? 1.0 : load->ratio;
    return friction_table_of(slow->system->tables, &slow->bristle, &slow->fast, waves);
}

/* The ratio may grow: the phase is near that of its middle. */
SlowFriction slow_friction_of(const System *system, double theta, double psi) {
    const Device *device = &system->device;
    double w = device->drive_frequency, first = system->inputs.frequency_ratio, middle = system->middle_ratio;
    int turns = turns_to_repeat(middle, max_turns_to_repeat(device), NEAR);
    double waves = turns > 0 ? nearbyint(turns * middle) / turns : first;
    double phase = system->inputs.phase + psi - waves * theta + waves * system->fast.lag;
    SlowFriction slow = {.system = system, .bristle = system->bristle, .fast = {system->fast.velocity, w}};
    if (system->fast.velocity == 0.0) {
        slow.bristle = (Bristle){system->bristle.coefficient, INFINITY, 0.0};
    }
    slow.stands = waves == 0.0;
    slow.load = vibrating_load_of(device, waves, phase);
    slow.chirp = system->plant.normal_rate;
    if (slow.chirp != 0.0 && ((turns == 0 && !slow.stands) || device->normal_amplitude == 0.0)) {
        /* The frequency ratio may begin at an integer, where the load would count with its phase. */
        slow.load = slow.stands ? slow.load : vibrating_load_flattened(&slow.load);
        slow.chirp = 0.0;
    } else {
        slow.drift = (first - waves) * w;
        slow.fastest = fmax(fabs(slow.drift), fabs((2.0 * middle - first - waves) * w));
    }
    slow.beat = slow.fastest != 0.0 ? TAU / ((turns > 0 ? turns : 1) * slow.fastest) : INFINITY;
    slow.table = table_of(&slow);
    return slow;
}

/* The load at a time [s]: as it is now, or `turned`. */
static const VibratingLoad *load_at(const SlowFriction *slow, double t, VibratingLoad *turned) {
    double gain = (slow->drift + 0.5 * slow->chirp * t) * t;
    if (gain == 0.0) {
        return &slow->load;
    }
    *turned = vibrating_load_turned(&slow->load, gain);
    return turned;
}

double slow_friction_at(const SlowFriction *slow, double t, double velocity) {
    double turning = turning_at(velocity, slow->fast.velocity), means[MEANS], face;
    VibratingLoad turned;
    const VibratingLoad *load = load_at(slow, t, &turned);
    if (slow->table == NULL) {
        face = mean_friction(&slow->bristle, &slow->fast, load, turning);
    } else {
        tabulated_means(slow->table, turning, means);
        double swung = cos(load->delta) * means[SINE] + load->sine * means[COSINE];
        face =
            load->is_constant ? load->constant * means[PLAIN] : load->preload * means[PLAIN] + load->amplitude * swung;
    }
    return slow->system->device.friction_faces * face;
}

double slow_friction_power(const SlowFriction *slow, double velocity) {
    double turning = turning_at(velocity, slow->fast.velocity);
    return slow->system->device.friction_faces *
           mean_power(&slow->bristle, &slow->fast, &slow->load, turning, velocity);
}
