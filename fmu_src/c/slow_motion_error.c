#include "slow_motion_error.h"

#include "elementary.h"

#include "state.h"
#include "velocity_scale.h"

/* Error of first order in friction shares and v_q: that of the average, and that of what the average leaves
 * out, the resonator's first swing and the first bend of bristles. */
#define FIRST_ORDER 2.0

/* Error of second order in squares of the friction share and v_q, with a resonator that is stiff against
 * the drive and with a soft one; more of it by the square of the damping ratio, and as a factor under a
 * contact that lifts; and in squares of the added mass. */
#define STIFF 0.8
#define SOFT 5.0
#define BY_DAMPING 6.0
#define BY_FLIGHT 2.0
#define ADDED_MASS 0.5

/* Drive frequency over resonator frequency up to which the resonator counts as stiff, and from which on as
 * soft. */
#define STIFF_UP_TO 1.5
#define SOFT_FROM 3.0

/* Error under a lead that drifts, in v_q and the share of friction that varies: by the drift over the drive
 * frequency, as the motion within a turn then belongs to no orbit; by the lag of the resonator and the
 * friction share in a beat; and by that lag and the drift on an average of beats. Fitted to 356 random devices. */
#define DRIFTING 0.6
#define LAGGING 0.3
#define LAGGING_ON_AVERAGE 0.015

/* Error under a load that grows, over the velocity at which it then bends the resonator by its inertia: more
 * than 1 for the swing with which that begins. */
#define LOADING 1.2

/* Error of the tables, in v_q; the share of the tolerance of LuGre friction that they err by where that is more; and
 * the least that the rule of thumb gives. */
#define RESOLUTION 1e-9
#define SHARE_OF_TOLERANCE 0.01
#define LEAST_BY_RULE 1e-8

/* Error of resolved motion in its scale of velocities: by rounding; and in tolerances of LuGre friction, that of a
 * moment, and that of a turn, which adds up for some decays of the slow motion: far from balance it decays later. */
#define ROUNDING 1e-14
#define RESOLVED_AT_ONCE 0.03
#define RESOLVED_IN_TURN 2.5e-3
#define DECAYS 3.0

/* Damping of bristles over Coulomb friction; 0 without bristles. A bristle bends over a path of 2 mu/s0 after
 * each of two reversals in a turn, and damps by the impulse of 2 mu s1/s0 per normal load; but by no more than
 * s1 v_q all the time. */
static double damping_of_bend(const Law *law) {
    const Device *device = &law->device;
    if (device->friction_law == 0) {
        return 0.0;
    }
    const Bristle *bristle = &law->bristle;
    double all_time = bristle->damping * law->fast.velocity / bristle->coefficient;
    double bends = 2.0 / PI * bristle->damping / bristle->stiffness * device->drive_frequency;
    return fmin(all_time, bends);
}

double friction_share(const Law *law) {
    const Device *device = &law->device;
    double normal = fmax(device->normal_preload, device->normal_amplitude / PI);
    double friction = device->friction_faces * device->friction_coefficient * normal *
                      hypot(1.0, damping_of_bend(law));
    return friction / (device_total_mass(device) * device->drive_frequency * law->fast.velocity);
}

double slow_decay_in_turn(const Law *law) {
    return 4.0 * friction_share(law);
}

double decay_in_turn(const Law *law) {
    const Device *device = &law->device;
    if (device->resonator_mass == 0.0) {
        return INFINITY;
    }
    double free_share = device->slider_mass / device_total_mass(device);
    double wn = device->resonator_frequency, decay = device->damping_ratio * wn / free_share;
    double excess = decay * decay - wn * wn / free_share;
    double slower = excess > 0.0 ? wn * wn / free_share / (decay + sqrt(excess)) : decay;
    return slower * TAU / device->drive_frequency;
}

double bristle_decay(const Law *law) {
    if (law->device.friction_law == 0) {
        return INFINITY;
    }
    double path = 4.0 * law->fast.velocity / law->device.drive_frequency;
    return law->bristle.stiffness * path / law->bristle.coefficient;
}

double first_order_error(const Law *law) {
    double share = law->fast.velocity > 0.0 ? friction_share(law) : 0.0;
    if (!(share > 0.0)) {
        return 0.0;
    }
    double decay = fmin(decay_in_turn(law), bristle_decay(law));
    double swing = decay > 0.0 ? 1.0 + 1.0 / decay : INFINITY;
    return fmin(FIRST_ORDER * share * swing, 1.0) * law->fast.velocity;
}

double second_order_error(const Law *law, double added_mass, double force) {
    const Device *device = &law->device;
    double share = friction_share(law);
    double inertia = device_total_mass(device) * device->drive_frequency * law->fast.velocity;
    double away = share > 0.0 ? fmin(fabs(force) / (share * inertia), 1.0) : 0.0;
    double tuning = device->drive_frequency / device->resonator_frequency;
    double soft = fmin(fmax((tuning - STIFF_UP_TO) / (SOFT_FROM - STIFF_UP_TO), 0.0), 1.0);
    double damping = fmin(device->damping_ratio, 1.0);
    double sensitivity = (STIFF + soft * (SOFT - STIFF)) * (1.0 + BY_DAMPING * damping * damping);
    if (device->normal_amplitude > device->normal_preload) {
        sensitivity *= BY_FLIGHT;
    }
    double squares = sensitivity * share * share +
                     ADDED_MASS * added_mass * added_mass;
    return fmin(away * squares + LEAST_BY_RULE, 1.0) * law->fast.velocity;
}

double table_accuracy(const Device *device) {
    bool lugre = device->friction_law != 0;
    return lugre ? fmax(RESOLUTION, SHARE_OF_TOLERANCE * device->tolerance) : RESOLUTION;
}

double resolution_error(const Law *law) {
    return table_accuracy(&law->device) * law->fast.velocity;
}

double resolved_error(const Law *law, double angle) {
    const Law *resolved = law->resolved;
    double turns = fmin(angle / TAU, DECAYS / slow_decay_in_turn(law)), share = ROUNDING;
    if (resolved->device.friction_law != 0) {
        share += (RESOLVED_AT_ONCE + RESOLVED_IN_TURN * turns) * resolved->device.tolerance;
    }
    double swing = complex_abs(law->fast.resonator) * law->device.drive_frequency;
    State vibrating = {.velocity = law->fast.velocity, .rate = swing};
    return share * velocity_scale(&resolved->held.plant, &vibrating);
}

/* The change of the slider's vibration by a change of friction, which the resonator delays: its delay in
 * radians of the drive, and its amplitude over that of the pair as one mass. Both are large near the free
 * resonance of the pair. */
static double resonator_lag(const Device *device) {
    double w = device->drive_frequency, wn = device->resonator_frequency;
    double ratio = device->resonator_mass / device->slider_mass, stiffness = (1.0 + ratio) * wn * wn;
    double damping = 2.0 * device->damping_ratio * (1.0 + ratio) * wn * w;
    double detuned = stiffness - w * w;
    return ratio * w * w * (stiffness + w * w) / (detuned * detuned + damping * damping);
}

double drift_error(const Law *law, double drift) {
    if (drift == 0.0) {
        return 0.0;
    }
    const Device *device = &law->device;
    double share = friction_share(law), turned = drift / device->drive_frequency;
    bool lifts = device->normal_amplitude > device->normal_preload;
    double varying = lifts ? 1.0 : device->normal_amplitude / device->normal_preload;
    /* The velocity follows a phase slower than itself, and leaves the lag behind. */
    double faster = turned / (turned + slow_decay_in_turn(law) / TAU);
    double lag = resonator_lag(device) * (lifts ? BY_FLIGHT : 1.0);
    double lagging = LAGGING * faster * share + LAGGING_ON_AVERAGE * varying * turned;
    return fmin(varying * share * (DRIFTING * turned + lag * lagging), 1.0) * law->fast.velocity;
}

double loading_error(const Law *law, double loading) {
    const Device *device = &law->device;
    double wn = device->resonator_frequency, inertia = device_total_mass(device) * wn * wn;
    double bending = device->resonator_mass > 0.0 ? fabs(loading) / inertia : 0.0;
    return fmin(LOADING * device_mass_fraction(device) * bending, law->fast.velocity);
}
