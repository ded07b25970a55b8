#include "resolved_start.h"

#include <math.h>

#include "slow_motion_error.h"
#include "state.h"

/* What may be left of the swing, over the steady one, and of the bend of a bristle. */
#define SWING_LEFT 1e-7

/* What may be left of a lag, over v_q. */
#define LAG_LEFT 1e-9

/* Most turns of the drive. */
#define MAX_TURNS_RESOLVED 1e5

/* Fewest turns: from rest under a direct drive motion begins where the slider just turns back, and its
 * friction is not slow until it has left that velocity. */
#define MIN_TURNS_RESOLVED 8.0

/* Largest swing, over the steady one, that counts. */
#define MAX_SWING 1e6

/* Drive angle [rad] until a `size` has become `left` at a decay in a turn. */
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

double swing_by_inertia(const Law *law) {
    double wn = law->device.resonator_frequency;
    return law->device.resonator_mass > 0.0 ? 1.0 / (wn * wn) : 0.0;
}

double velocity_of_swing(const Law *law, double swing) {
    return device_mass_fraction(&law->device) * swing * law->device.drive_frequency / PI;
}

double lag_angle(const Law *law, double added_mass) {
    double decay = fmin(decay_in_turn(law), bristle_decay(law));
    return angle_until(added_mass * added_mass, LAG_LEFT, decay);
}
