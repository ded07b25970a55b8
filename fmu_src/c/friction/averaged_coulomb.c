/* Averaged Coulomb friction (eqs 4 and 20): elementary integrals over the two arcs of sliding. */
#include "../base/elementary.h"
#include "../device/state.h"
#include "averaged_friction.h"

static double grip(const Bristle *bristle, double amplitude, double frequency) {
    (void)amplitude;
    (void)frequency;
    return bristle->coefficient;
}

static double drag(const Bristle *bristle, double fast_velocity) {
    (void)bristle;
    (void)fast_velocity;
    return 0.0;
}

static double mean(const Bristle *bristle, const FastMotion *fast, const VibratingLoad *load,
                   double turning) {
    (void)fast;
    return bristle->coefficient / TAU * vibrating_load_difference(load, turning);
}

static FrictionMeans means(const Bristle *bristle, const FastMotion *fast, double n,
                           double turning) {
    double mu = bristle->coefficient;
    (void)fast;
    return (FrictionMeans){mu * (1.0 - 2.0 / PI * turning), 0.0,
                           -2.0 * mu / (n * PI) * sin(n * turning)};
}

static double bend_damping(const Bristle *bristle, const FastMotion *fast) {
    (void)bristle;
    (void)fast;
    return 0.0;
}

static double bend_decay(const Bristle *bristle, const FastMotion *fast) {
    (void)bristle;
    (void)fast;
    return INFINITY;
}

const AveragedFriction AVERAGED_COULOMB = {
    .is_expensive = false,
    .grip = grip,
    .drag = drag,
    .mean = mean,
    .means = means,
    .bend_damping = bend_damping,
    .bend_decay = bend_decay,
};
