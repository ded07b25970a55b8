#include "resolved_start.h"

#include "elementary.h"
#include "slow_motion_error.h"
#include "state.h"

/* Relative size to which the resonator's transient and the transient of a bristle must have decayed. */
#define SWING_LEFT 1e-7

/* Size, over v_q, to which a lag must have decayed. */
#define LAG_LEFT 1e-9

/* Largest number of turns of the drive that are resolved. */
#define MAX_TURNS_RESOLVED 1e5

/* Smallest number of turns that are resolved: from rest under a direct drive the motion begins at grazing,
 * and its mean friction is not smooth until it has left that velocity. */
#define MIN_TURNS_RESOLVED 8.0

/* Limit of the transient, relative to the steady vibration. */
#define MAX_SWING 1e6

/* Change of slow velocity by friction, over that of the slider's vibration by a swing: that of mean friction in a turn
 * at 0.7 of the fast velocity, as long as it lasts. */
#define BY_FRICTION 4.0

/* Drive angle [rad], whole turns, in which `size` decays to `left`; `decay` is that of a turn. */
static double angle_until(double size, double left, double decay) {
    return size > left ? TAU * ceil(log(size / left) / decay) : 0.0;
}

bool resolved_is_bounded(const Law *law) {
    double decay = fmin(decay_in_turn(law), bristle_decay(law));
    return decay * MAX_TURNS_RESOLVED > log(MAX_SWING / SWING_LEFT);
}

double bend_angle(double decay) {
    return angle_until(1.0, SWING_LEFT, decay);
}

double min_bend_decay(const Law *law) {
    return 0.5 * bristle_decay(law);
}

bool bend_is_slow(const Law *law) {
    return bend_angle(min_bend_decay(law)) > TAU * MIN_TURNS_RESOLVED;
}

double resolved_angle(const Law *law, const Moment *moment) {
    double w = law->device.drive_frequency, apart = 0.0;
    if (law->device.resonator_mass > 0.0) {
        Response steady = steady_swing(law->fast.resonator, moment->theta, w);
        double size = fmax(complex_abs(law->fast.resonator), law->fast.velocity / w);
        apart = hypot(moment->state.displacement - steady.displacement,
                      (moment->state.rate - steady.rate) / w) / size;
    }
    double swing = angle_until(fmin(apart, MAX_SWING), SWING_LEFT, decay_in_turn(law));
    double bend = bend_angle(bristle_decay(law));
    return fmax(TAU * MIN_TURNS_RESOLVED, fmax(swing, bend));
}

double swing_by_inertia(const Law *law) {
    double wn = law->device.resonator_frequency;
    return law->device.resonator_mass > 0.0 ? 1.0 / (wn * wn) : 0.0;
}

double velocity_of_swing(const Law *law, double swing) {
    return device_mass_fraction(&law->device) * swing * law->device.drive_frequency / PI;
}

/* How far a free swing of the resonator is from itself a turn later, over its size. */
static double apart_in_turn(const Law *law) {
    const Oscillator *slip = &law->resolved->held.plant.slip;
    double w = law->device.drive_frequency;
    Response free = free_response(slip, TAU / w);
    return hypot(free.displacement + slip->decay * free.rate - 1.0, w * free.rate);
}

double velocity_by_friction(const Law *law, double swing) {
    double velocity = PI * velocity_of_swing(law, swing);
    return velocity > 0.0 ? velocity * BY_FRICTION * friction_share(law) / apart_in_turn(law) : 0.0;
}

double velocity_of_free_swing(const Law *law, double swing) {
    double within = 0.5 * velocity_of_swing(law, swing) * apart_in_turn(law);
    return within + velocity_by_friction(law, swing);
}

double lag_angle(const Law *law, double added_mass) {
    double decay = fmin(decay_in_turn(law), bristle_decay(law));
    return angle_until(added_mass * added_mass, LAG_LEFT, decay);
}
