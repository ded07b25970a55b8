#include "experiment.h"

#include <math.h>

/* Share of a step by which hosts may round their own time. */
#define TIME_SLACK 1e-6

double experiment_end(const Experiment *experiment) {
    return experiment->stop_time_defined ? experiment->stop_time : INFINITY;
}

bool experiment_check(const Experiment *experiment, Refusal *refusal) {
    char text[NUMBER_SIZE], start[NUMBER_SIZE];
    double stop_time = experiment_end(experiment);
    if (!isfinite(experiment->start_time)) {
        return refuse(refusal, "startTime = %s refused: allowed is a finite number",
                      number_text(experiment->start_time, text));
    }
    if (!(stop_time >= experiment->start_time)) {
        return refuse(refusal, "stopTime = %s refused: allowed is a number from startTime = %s on",
                      number_text(stop_time, text), number_text(experiment->start_time, start));
    }
    if (experiment->tolerance_defined
        && !(isfinite(experiment->tolerance) && experiment->tolerance > 0.0)) {
        return refuse(refusal, "tolerance = %s refused: allowed is a finite number above 0",
                      number_text(experiment->tolerance, text));
    }
    return true;
}

bool step_check(double now, double stop_time, double time, double step_size, Refusal *refusal) {
    char given[NUMBER_SIZE], allowed[NUMBER_SIZE];
    if (!(isfinite(step_size) && step_size > 0.0)) {
        return refuse(refusal, "doStep: communicationStepSize = %s refused: allowed is a finite "
                      "number above 0", number_text(step_size, given));
    }
    double spacing = nextafter(fabs(now), INFINITY) - fabs(now);
    double slack = TIME_SLACK * step_size + 4.0 * spacing;
    if (!(fabs(time - now) <= slack)) {
        return refuse(refusal, "doStep: currentCommunicationPoint = %s refused: allowed is the "
                      "present time %s", number_text(time, given), number_text(now, allowed));
    }
    if (time + step_size > stop_time + slack + 1e-9 * fabs(stop_time)) {
        return refuse(refusal, "doStep: communicationStepSize = %s refused: allowed is a step up "
                      "to stopTime = %s", number_text(step_size, given),
                      number_text(stop_time, allowed));
    }
    return true;
}
