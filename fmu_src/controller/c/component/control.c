#include "control.h"

#include <math.h>

static double limited(double value, double limit) {
    return fmax(-limit, fmin(limit, value));
}

Control control_sampled(const Tuning *tuning, Control before, double error) {
    double limit = tuning->effort_limit;
    double unlimited = tuning->proportional_gain * error + before.integral;
    Control after = {limited(before.integral, limit), limited(unlimited, limit)};
    if (after.effort == unlimited || (unlimited > 0.0) != (error > 0.0)) {
        double gained = tuning->integral_gain * tuning->sample_time * error;
        after.integral = limited(before.integral + gained, limit);
    }
    return after;
}

double control_phase(double effort, double force_phase) {
    return asin(effort) - force_phase;
}
