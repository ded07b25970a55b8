#include "bending_outlook.h"

#include <math.h>

#include "gauss_nodes.h"

/* Exponent of E at which its decay is looked at first. */
#define GUESSED_EXPONENT 16.0

/* How much longer than the time expected a panel is, to be sure. */
#define LONGER 1.02

/* Largest force of the bristle over what moves the slider otherwise for which panels are tried. */
#define MAX_CONTRACTION 0.3

/* Share of its velocity under full friction that a slider must surely have left. */
#define SURE 0.1

/* Of what interpolation misses: what of it displaces the slider within the panel, and what of it is in
 * the velocity there. */
#define DISPLACING 0.05
#define WITHIN 0.1

/* Share of the tolerance for which nodes are chosen. */
#define NODES_SHARE 0.3

BendingMotion bending_outlook(BendingOutlook *outlook, const Held *held, const Bristle *bristle,
                              int direction, const Moment *now, const Phasors *phasors,
                              double tolerance) {
    const Plant *plant = &held->plant;
    double mu = bristle->coefficient, speed = fabs(now->state.velocity);
    double moving = direction * force_by(plant, &now->state, phasors) -
                    friction_limit_by(plant, phasors);
    double limit = plant->friction_preload + plant->friction_amplitude;
    outlook->rate = bristle->stiffness / mu;
    outlook->lag = bristle->damping / bristle->stiffness;
    outlook->bend = (mu - direction * now->bristle) / mu;
    outlook->push = outlook->bend * limit / plant->slider_mass;
    outlook->speed = speed;
    outlook->acceleration = moving / plant->slider_mass;
    double drive = outlook->acceleration + 0.5 * outlook->rate * speed * speed;
    outlook->contraction = outlook->push / drive;
    if (!(outlook->bend > 0.0 && outlook->bend <= 2.0 && drive > 0.0 &&
          outlook->contraction < MAX_CONTRACTION)) {
        return BY_SERIES;
    }
    double path = GUESSED_EXPONENT / outlook->rate;
    double square = speed * speed + 2.0 * outlook->acceleration * path;
    if (!(square > 0.25 * speed * speed)) {
        return BY_SERIES;
    }
    double time = 1.0 / (outlook->rate * sqrt(square)) + outlook->lag;
    outlook->exponent = log(outlook->push * time / tolerance);
    return outlook->exponent > 0.0 ? BY_PANEL : AS_BENT;
}

double bending_time(const BendingOutlook *outlook) {
    double speed = outlook->speed, path = outlook->exponent / outlook->rate;
    return 2.0 * path / (speed + sqrt(speed * speed + 2.0 * outlook->acceleration * path));
}

/* Derivative of the acceleration at the start of a slide [m/s^3]. */
static double jerk_of(const SplitSlide *slide) {
    const Plant *plant = slide->plant;
    const Phasors *start = &slide->start.phasors;
    double w = plant->drive_frequency, q = plant->normal_frequency;
    Complex eigenvalue = plant->slip.eigenvalue;
    double jerk = -w * w * complex_mul(slide->velocity_drive, start->drive).re;
    if (!slide->split->merges) {
        jerk -= q * q * complex_mul(slide->velocity_normal, start->normal).re;
    }
    return jerk + complex_mul(complex_mul(eigenvalue, eigenvalue), slide->velocity_free).re;
}

double bending_time_along(const BendingOutlook *outlook, const SplitSlide *slide, double time) {
    double half_jerk = 0.5 * slide->direction * jerk_of(slide);
    double half = 0.5 * outlook->acceleration, path = outlook->exponent / outlook->rate;
    double ahead = time * (outlook->speed + time * (half + time * half_jerk / 3.0)) - path;
    double speed = outlook->speed + time * (outlook->acceleration + time * half_jerk);
    return speed > 0.0 ? LONGER * (time - ahead / speed) : NAN;
}

double bending_weight(const BendingOutlook *outlook, double length) {
    return outlook->push * (0.5 * length + outlook->lag);
}

int bending_nodes(const BendingOutlook *outlook, double length, bool ends_within, double tolerance) {
    double weight = bending_weight(outlook, length) / (NODES_SHARE * tolerance);
    double missed = fmax(DISPLACING * outlook->contraction * weight, 0.15 * sqrt(weight));
    if (ends_within) {
        missed = fmax(missed, WITHIN * weight);
    }
    double width = 1.15 * outlook->exponent + (outlook->speed > 0.0 ? 3.0 : 6.0);
    double places = missed > 1.0 ? sqrt(width * log(missed)) : 0.0;
    if (!(places < MAX_NODES - 1)) {
        return 0;
    }
    int steps = (int)(places + NODES_STEP) / NODES_STEP * NODES_STEP;
    return steps < MIN_NODES ? MIN_NODES : steps;
}

/* Bound on G' over 1 / M within `length` [s]; NAN where G' may be negative. */
static double response_bound(const Plant *plant, double length) {
    const Oscillator *slip = &plant->slip;
    double share = plant->slider_mass / plant->total_mass;
    double swing = plant->mass_fraction * slip->frequency / slip->eigenvalue.im;
    return swing < share || slip->frequency * length < 0.5 ? share + swing : NAN;
}

/* A parabola is below the velocity under full friction. f takes from it at most what comes with E' < 0,
 * push rho (1 - E), and 1 - E is at most k times the path. */
bool bending_goes_on(const BendingOutlook *outlook, const SplitSlide *slide, double length) {
    double bound = slide->bound + slide->free_bound;
    double push = outlook->push * response_bound(slide->plant, length);
    double fastest = fmax(outlook->acceleration, 0.0) + push + bound * length;
    double gained = outlook->speed + outlook->acceleration * length;
    double path = (outlook->speed + 0.5 * fastest * length) * length;
    double lost = 0.5 * bound * length * length + push * outlook->lag * outlook->rate * path;
    return (outlook->speed > 0.0 || outlook->acceleration > 0.0) &&
           gained - lost > SURE * gained + slide->noise;
}

/* E is entire, so its Legendre coefficients fall ever faster: those of twice the order, which integrals up
 * to the end miss, are below the square of the last one by 2^(-nodes) and more. */
double bending_error(double weight, double share, double contraction, int nodes, bool ends_within) {
    double error = weight * share * (DISPLACING * contraction + ldexp(share, -nodes / 2));
    return ends_within ? fmax(error, WITHIN * weight * share) : error;
}
