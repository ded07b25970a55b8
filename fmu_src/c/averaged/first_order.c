#include "first_order.h"

#include "../base/elementary.h"
#include "mean_friction.h"

/* Halvings of [0, pi] that select one of several balances. */
enum { SORTING = 4 };

/* Width [rad] at which the angle of balance is known. */
#define CLOSE 2e-15

/* Rounding error of a mean friction, in units of the last place of the largest friction. */
#define ROUNDING 8.0

/* Friction and load as functions of the angle Theta at which sliding turns forward; `noise` is the rounding error of
 * their sum [N]. Several angles may balance where friction rises with the angle. */
typedef struct {
    const System *system;
    double noise;
    FastMotion fast;
    VibratingLoad load;
} Balance;

/* By how much friction and load exceed rounding (`excess`) [N] at an angle Theta (`turning`) [rad]. */
typedef struct {
    double turning, excess;
} Point;

static Balance balance_of(const System *system, double normal_lead) {
    const Device *device = &system->device;
    const FastVibration *fast = &system->fast;
    Balance balance = {.system = system};
    double ratio = system->inputs.frequency_ratio, faces = device->friction_faces;
    double delta = system->inputs.phase + normal_lead + ratio * fast->lag;
    balance.fast = (FastMotion){fast->velocity, device->drive_frequency};
    balance.load = vibrating_load_of(device, ratio, delta);
    double mu = system->bristle.coefficient;
    double drag = system->bristle.damping * balance.fast.velocity;
    balance.noise = ROUNDING * EPSILON * faces * (mu + drag) * (device->normal_preload + device->normal_amplitude);
    return balance;
}

/* Mean friction [N] when sliding turns forward at tau = `turning` [rad]. */
static double friction_at(const Balance *balance, double turning) {
    const System *system = balance->system;
    return system->device.friction_faces * mean_friction(&system->bristle, &balance->fast, &balance->load, turning);
}

/* Share of the way from the newest point `a` to the opposite one `b`, by inverse quadratic interpolation through these
 * and the one before, `c`, where Chandrupatla's criterion accepts it; a half otherwise. */
static double next_share(Point a, Point b, Point c) {
    double xi = (a.turning - b.turning) / (c.turning - b.turning);
    double phi = (a.excess - b.excess) / (c.excess - b.excess);
    if (!(phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi)) {
        return 0.5;
    }
    return a.excess / (b.excess - a.excess) * c.excess / (b.excess - c.excess) +
           (c.turning - a.turning) / (b.turning - a.turning) * a.excess / (c.excess - a.excess) * b.excess /
               (c.excess - b.excess);
}

/* Angle to which halving leads where friction and load balance [rad], by Chandrupatla's method. Where they balance over
 * a range of angles (even ratios, with flight while sliding turns) it is the end of the highest velocity: what is 0
 * within rounding counts as below 0. */
static double balanced_turning(const Balance *balance, Point low, Point high) {
    double share = 0.5;
    for (int i = 0; high.turning - low.turning > CLOSE; i++) {
        double width = high.turning - low.turning, min_share = CLOSE / (2.0 * width);
        double turning = low.turning + share * width;
        double sum = friction_at(balance, turning) + balance->system->inputs.load;
        Point next = {turning, sum - balance->noise};
        bool above = next.excess > 0.0;
        Point before = above ? low : high;
        *(above ? &low : &high) = next;
        share = 0.5;
        if (i >= SORTING && low.excess > 0.0 && !(high.excess > 0.0)) {
            share = above ? next_share(low, high, before) : 1.0 - next_share(high, low, before);
            share = fmin(fmax(share, min_share), 1.0 - min_share);
        }
    }
    return 0.5 * (low.turning + high.turning);
}

/* Whether the vibration alone overcomes the mean `friction` [N] of sliding: the amplitude of its force on the pair
 * must, and so must that of its force on a held slider. */
static bool breaks_loose(const Balance *balance, double friction) {
    const Device *device = &balance->system->device;
    const Bristle *bristle = &balance->system->bristle;
    double w = balance->fast.frequency, amplitude = balance->fast.velocity / w;
    double force = device_total_mass(device) * w * balance->fast.velocity;
    /* A vibration far shorter than mu / sigma_0 only bends the bristle. */
    double grip = fmin(bristle->coefficient, amplitude * hypot(bristle->stiffness, w * bristle->damping));
    return fmin(force, held_amplitude(device)) > friction * (grip / bristle->coefficient);
}

Prediction first_order_prediction(const System *system, double normal_lead, Quantity quantity) {
    if (system->fast.velocity == 0.0) {
        return (Prediction){0.0, false, false};
    }
    Balance balance = balance_of(system, normal_lead);
    double first = friction_at(&balance, 0.0), last = friction_at(&balance, PI);
    double load = system->inputs.load;
    if (first == last) {
        /* No friction: every velocity is steady without a load, and none with one. */
        double fastest = load != 0.0 ? -copysign(balance.fast.velocity, load) : 0.0;
        return (Prediction){quantity == STEADY_VELOCITY ? fastest : 0.0, false, false};
    }
    bool holds = fabs(load) < first;
    bool valid = holds && breaks_loose(&balance, first);
    if (quantity == BLOCKING_FORCE) {
        return (Prediction){-friction_at(&balance, 0.5 * PI), holds, valid};
    }
    Point low = {0.0, first + load - balance.noise}, high = {PI, last + load - balance.noise};
    return (Prediction){balance.fast.velocity * cos(balanced_turning(&balance, low, high)), holds, valid};
}
