#include "runge_kutta.h"

#include "elementary.h"

/* Dormand and Prince's pair; the last stage is the first of the next step. */
enum { STAGES = 7 };

static const double NODES[STAGES] = {0.0, 1.0 / 5, 3.0 / 10, 4.0 / 5, 8.0 / 9, 1.0, 1.0};
static const double WEIGHTS[STAGES][STAGES] = {
    {0.0},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0.0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
};
static const double ERROR[STAGES] = {
    71.0 / 57600, 0.0, -71.0 / 16695, 71.0 / 1920, -17253.0 / 339200, 22.0 / 525, -1.0 / 40,
};

/* Bounds of the growth of a step, and the share of the best growth that is taken. */
#define MIN_GROWTH 0.2
#define MAX_GROWTH 5.0
#define SAFETY 0.9

bool runge_kutta_step(SlowRateFunction rate, void *motion, const SlowPoint *from, double h, SlowStep *step) {
    SlowRate rates[STAGES] = {from->rate};
    double error = h * ERROR[0] * from->rate.acceleration, before = 0.0, gained = 0.0;
    SlowPoint to = *from;
    for (int i = 1; i < STAGES; i++) {
        double travel = 0.0;
        gained = 0.0;
        for (int j = 0; j < i; j++) {
            gained += WEIGHTS[i][j] * rates[j].acceleration;
            travel += WEIGHTS[i][j] * rates[j].travel;
        }
        before = to.velocity;
        to.t = from->t + NODES[i] * h;
        to.velocity = from->velocity + h * gained;
        to.travel = from->travel + h * travel;
        if (!rate(motion, to.t, to.velocity, &rates[i])) {
            return false;
        }
        error += h * ERROR[i] * rates[i].acceleration;
    }
    to.rate = rates[STAGES - 1];
    double risen = to.rate.acceleration - rates[STAGES - 2].acceleration;
    double moved = to.velocity - before, gain = moved != 0.0 ? risen / moved : 0.0;
    *step = (SlowStep){to, h * gained, fabs(error), gain, risen};
    return true;
}

double step_growth(double error, double tolerance) {
    double growth = error > 0.0 ? SAFETY * exp(log(tolerance / error) / ORDER) : MAX_GROWTH;
    return fmin(MAX_GROWTH, fmax(MIN_GROWTH, growth));
}
