#include "bending_outlook.h"

#include <math.h>

#include "gauss_nodes.h"

/* Exponent of E at which the decay of f is first estimated. */
#define GUESSED_EXPONENT 16.0

/* Share of the tolerance for the part of f after the panel, which is dropped. It is small because this
 * error has the same sign at each reversal, and adds up. */
#define LEFT_OUT 0.2

/* Safety factor on the estimated length of a panel. */
#define LONGER 1.02

/* Largest ratio of the bristle's force f to the force that moves the slider for which panels are tried. */
#define MAX_CONTRACTION 0.3

/* Largest angle [rad] that drive or normal load may turn by within rho, the time by which damping lags. */
#define MAX_LAG 1.0

/* Shortest and longest panel, as angles [rad] of the fastest oscillation. */
#define MIN_ARC 1e-9
#define MAX_ARC 2.0

/* Series are as cheap as a panel of which less than MIN_SHARE is used, and where E does not fall to
 * exp(-MIN_EXPONENT): within MAX_ARC, or within the whole motion if that is shorter than MIN_SLIDE [rad] of
 * the fastest oscillation. */
#define MIN_SHARE 0.5
#define MIN_SLIDE 1.0
#define MIN_EXPONENT 5.0

/* Share of its velocity under full friction that the slider is guaranteed to keep in a panel. */
#define SURE 0.1

/* Shares of the interpolation error of f that appear in the displacement, and in the velocity, within the
 * panel. */
#define DISPLACING 0.05
#define WITHIN 0.1

/* Share of the tolerance that the number of nodes is chosen for. */
#define NODES_SHARE 0.3

/* Derivative of the acceleration under full friction [m/s^3]. */
static double jerk_of(const Plant *plant, int direction, double acceleration, const State *state,
                      const Phasors *phasors) {
    double w = plant->drive_frequency, q = plant->normal_frequency;
    double changing = direction * plant->friction_amplitude * q * normal_phasor(plant, phasors).re;
    double swing = plant->base_acceleration * phasors->drive.im - acceleration -
                   2.0 * plant->stick.decay * state->rate -
                   plant->stick.stiffness * state->displacement;
    double direct = w * complex_mul(plant->holding_drive, phasors->drive).re;
    double jerk = plant->spring * state->rate + plant->damper * swing + direct - changing;
    return jerk / plant->slider_mass;
}

/* Time [s] to travel `path` [m]: from speed and acceleration, with one correction for the jerk. NAN if the
 * slider stops before. */
static double time_for(const BendingOutlook *outlook, double path) {
    double speed = outlook->speed, half = 0.5 * outlook->acceleration;
    double t = 2.0 * path / (speed + sqrt(speed * speed + 4.0 * half * path));
    double ahead = t * (speed + t * (half + t * outlook->jerk / 6.0)) - path;
    double reached = speed + t * (outlook->acceleration + 0.5 * t * outlook->jerk);
    return reached > 0.0 ? t - ahead / reached : NAN;
}

BendingMotion bending_outlook(BendingOutlook *outlook, const Held *held, const Bristle *bristle,
                              int direction, const Moment *now, const Phasors *phasors,
                              double longest, double tolerance) {
    const Plant *plant = &held->plant;
    const State *state = &now->state;
    double mu = bristle->coefficient, speed = fabs(state->velocity);
    double resisting = direction * friction_limit_by(plant, phasors);
    double acceleration = (force_by(plant, state, phasors) - resisting) / plant->slider_mass;
    double limit = plant->friction_preload + plant->friction_amplitude;
    double reach = MAX_ARC / held->split.fastest, slide = MIN_SLIDE / held->split.fastest;
    double first = longest < slide ? longest : reach;
    outlook->speed = speed;
    outlook->acceleration = direction * acceleration;
    outlook->rate = bristle->stiffness / mu;
    if (!(outlook->rate * first * (speed + 0.5 * outlook->acceleration * first) > MIN_EXPONENT)) {
        return BY_SERIES;
    }
    outlook->bend = (mu - direction * now->bristle) / mu;
    outlook->push = outlook->bend * limit / plant->slider_mass;
    double drive = outlook->acceleration + 0.5 * outlook->rate * speed * speed;
    if (!(outlook->bend > 0.0 && outlook->bend <= 2.0 &&
          outlook->push < MAX_CONTRACTION * drive)) {
        return BY_SERIES;
    }
    double path = GUESSED_EXPONENT / outlook->rate;
    double square = speed * speed + 2.0 * outlook->acceleration * path;
    double guessed = sqrt(square);
    if (!(square > 0.25 * speed * speed && path < reach * (speed + guessed))) {
        return BY_SERIES;
    }
    outlook->lag = bristle->damping / bristle->stiffness;
    double time = 1.0 / (outlook->rate * guessed) + outlook->lag;
    outlook->exponent = log(outlook->push * time / (LEFT_OUT * tolerance));
    if (outlook->exponent <= 0.0) {
        return AS_BENT;
    }
    double fastest = fmax(plant->drive_frequency, fabs(plant->normal_frequency));
    if (outlook->lag * fastest > MAX_LAG) {
        return BY_SERIES;
    }
    outlook->contraction = outlook->push / drive;
    outlook->starts_slow = 2.0 * speed < guessed;
    outlook->jerk = direction * jerk_of(plant, direction, acceleration, state, phasors);
    outlook->length = LONGER * time_for(outlook, outlook->exponent / outlook->rate);
    double shortest = MIN_ARC / held->split.fastest;
    bool fits = shortest < outlook->length && outlook->length < reach &&
                MIN_SHARE * outlook->length < longest;
    return fits && (longest > slide || outlook->exponent > MIN_EXPONENT) ? BY_PANEL : BY_SERIES;
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
    double width = 1.15 * outlook->exponent + (outlook->starts_slow ? 6.0 : 3.0);
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

/* A parabola bounds the velocity under full friction from below. Of f only the part with E' < 0 decreases
 * the velocity: by push rho (1 - E), where 1 - E is at most k times the path. */
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

/* E is an entire function, so its Legendre coefficients fall ever faster. Integrals up to the end miss only
 * those of twice the order, which are below 2^(-nodes) times the square of the last one. */
double bending_error(double weight, double share, double contraction, int nodes, bool ends_within) {
    double error = weight * share * (DISPLACING * contraction + ldexp(share, -nodes / 2));
    return ends_within ? fmax(error, WITHIN * weight * share) : error;
}
