#include "period.h"

#include "device.h"

/* The passage at time `t` [s]. Close to the end of the interval, where steps of whole periods ask for it, the
 * displacement follows from that at the end. */
static Passage passage_until(const Interval *interval, double t, double frequency) {
    double rest = interval->duration - t;
    Passage passage = rest == 0.0 ? interval->passed : interval->passage_at(interval->motion, t);
    if (fabs(rest) * frequency <= PERIOD_END_TOLERANCE) {
        passage.travel = interval->passed.travel - interval->velocity * rest;
    }
    return passage;
}

double period_advance(PeriodMeans *means, const Interval *interval, double theta, double frequency) {
    double duration = interval->duration, end = theta + frequency * duration;
    double ended = end + PERIOD_END_TOLERANCE < TAU ? 0.0 : floor((end + PERIOD_END_TOLERANCE) / TAU);
    if (!(ended > 0.0)) {
        means->travel += interval->passed.travel;
        means->work += interval->passed.work;
        means->elapsed += duration;
        means->sticking += interval->sticks ? duration : 0.0;
        return end;
    }
    double last = (TAU * ended - theta) / frequency;
    Passage until = passage_until(interval, last, frequency);
    Passage before = {-means->travel, -means->work};
    double length = means->elapsed + last, sticking = means->sticking + (interval->sticks ? last : 0.0);
    if (ended > 1.0) {
        length = TAU / frequency;
        before = passage_until(interval, last - length, frequency);
        sticking = interval->sticks ? length : 0.0;
    }
    means->mean_velocity = (until.travel - before.travel) / length;
    means->friction_power = (until.work - before.work) / length;
    means->complete = 1.0;
    means->stick_fraction = fmin(fmax(sticking / length, 0.0), 1.0);
    means->travel = interval->passed.travel - until.travel;
    means->work = interval->passed.work - until.work;
    means->elapsed = duration - last;
    means->sticking = interval->sticks ? means->elapsed : 0.0;
    return end - TAU * ended;
}

/* The `mean` of the last whole period; before one has ended that of `sum` since the start, and at the start `first`. */
static double mean_of(const PeriodMeans *means, double mean, double sum, double first) {
    if (means->complete != 0.0) {
        return mean;
    }
    return means->elapsed > 0.0 ? sum / means->elapsed : first;
}

double period_mean_velocity(const PeriodMeans *means, double velocity) {
    return mean_of(means, means->mean_velocity, means->travel, velocity);
}

double period_friction_power(const PeriodMeans *means, double power) {
    return mean_of(means, means->friction_power, means->work, power);
}

double period_stick_fraction(const PeriodMeans *means, bool sticks) {
    return fmin(mean_of(means, means->stick_fraction, means->sticking, sticks ? 1.0 : 0.0), 1.0);
}
