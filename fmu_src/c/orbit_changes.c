#include "orbit_changes.h"

#include "constants.h"
#include "elementary.h"
#include "orbit_ride.h"
#include "slow_motion_error.h"

OrbitValues orbit_values_of(const Law *law) {
    const Device *device = &law->device;
    return (OrbitValues){
        .phase = law->inputs.phase,
        .load = law->inputs.load,
        .ratio = law->inputs.frequency_ratio,
        .waves = orbit_phase_of(law).waves,
        .preload = device->normal_preload,
        .amplitude = device->normal_amplitude,
        .coefficient = device->friction_coefficient,
        .base = device->base_amplitude,
        .frequency = device->drive_frequency,
        .force = device->tangential_force,
    };
}

/* What rounding leaves between an input that has grown and the value that a host then sets: angle [rad],
 * and share of a load. */
#define SAME_INPUT 1e-12

/* Whether the lead has another phase or rate than at the end of the last step. */
static bool is_led(const OrbitState *orbit, const OrbitValues *present, bool drifts) {
    double turned = remainder(present->phase - orbit->under.phase, TAU);
    if (present->waves != orbit->under.waves || (orbit->varied == VARIED_LEAD && !drifts)) {
        return true;
    }
    return orbit->varied == HELD_INPUTS ? present->phase != orbit->under.phase
                                        : fabs(turned) > SAME_INPUT;
}

static bool is_loaded(const OrbitState *orbit, const OrbitValues *present) {
    double before = orbit->under.load, tolerance = SAME_INPUT * fabs(before);
    return orbit->varied == HELD_INPUTS ? present->load != before
                                        : fabs(present->load - before) > tolerance;
}

OrbitChanges orbit_note_changes(const Law *law, OrbitState *orbit) {
    const OrbitValues before = orbit->under, present = orbit_values_of(law);
    const SlowPhase slow = orbit_phase_of(law);
    bool driven = present.base != before.base || present.frequency != before.frequency ||
                  present.force != before.force;
    OrbitChanges changes = {.drifts = slow_phase_drifts(&slow), .loaded = is_loaded(orbit, &present)};
    changes.shaken = driven || orbit->stage == AVERAGED;
    changes.tuned = present.preload != before.preload || present.amplitude != before.amplitude ||
                    present.coefficient != before.coefficient;
    changes.led = is_led(orbit, &present, changes.drifts);
    changes.turned = orbit->varied != VARIED_LEAD && present.ratio != before.ratio;
    orbit->under = present;
    orbit->varied = HELD_INPUTS;
    orbit->loading = 0.0;
    if (orbit->stage == AVERAGED) {
        orbit->doubt = first_order_error(law);
    }
    if ((changes.shaken || changes.tuned) && orbit->tunings < MAX_TUNINGS) {
        orbit->tunings++;
    }
    if (driven || changes.tuned) {
        orbit->paid = (PaidTables){.count = 0};
    }
    return changes;
}
