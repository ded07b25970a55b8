#include "resolved_start.h"

#include <math.h>

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

/* Drive angle [rad], whole turns, in which `size` decays to `left`; `decay` is that of a turn. */
static double angle_until(double size, double left, double decay) {
    return size > left ? TAU * ceil(log(size / left) / decay) : 0.0;
}

bool resolved_is_bounded(const Law *law) {
    double decay = fmin(decay_in_turn(law), bristle_decay(law));
    return decay * MAX_TURNS_RESOLVED > log(MAX_SWING / SWING_LEFT);
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
    double bend = angle_until(1.0, SWING_LEFT, bristle_decay(law));
    return fmax(TAU * MIN_TURNS_RESOLVED, fmax(swing, bend));
}

double lag_angle(const Law *law, double added_mass) {
    double decay = fmin(decay_in_turn(law), bristle_decay(law));
    return angle_until(added_mass * added_mass, LAG_LEFT, decay);
}
