#include "experiment.h"

#include "../base/constants.h"
#include "../base/refusal_texts.h"

bool experiment_check(const Experiment *experiment, Refusal *refusal) {
    double stop_time = experiment->stop_time, tolerance = experiment->tolerance;
    if (!isfinite(experiment->start_time)) {
        return refuse_bad_start_time(refusal, experiment->start_time);
    }
    if (!(stop_time >= experiment->start_time)) {
        return refuse_bad_stop_time(refusal, stop_time, experiment->start_time);
    }
    if (experiment->tolerance_defined && !(isfinite(tolerance) && tolerance > 0.0)) {
        return refuse_bad_tolerance(refusal, tolerance);
    }
    return true;
}

bool step_check(double now, double stop_time, double time, double step_size, Refusal *refusal) {
    if (!(isfinite(step_size) && step_size > 0.0)) {
        return refuse_bad_step_size(refusal, step_size);
    }
    double spacing = nextafter(fabs(now), INFINITY) - fabs(now);
    double slack = TIME_SLACK * step_size + 4.0 * spacing;
    if (!(fabs(time - now) <= slack)) {
        return refuse_bad_step_start(refusal, time, now);
    }
    if (time + step_size > stop_time + slack + STOP_TIME_SLACK * fabs(stop_time)) {
        return refuse_step_beyond_stop(refusal, step_size, stop_time);
    }
    return true;
}
