#include "bending_panel.h"

#include <math.h>

/* Exponent of E to which a first guess lets bristles bend. */
#define GUESSED_EXPONENT 16.0

/* How much longer than the guess a panel is, to be sure. */
#define LONGER 1.02

/* Largest force of the bristle over the force that moves the slider, and with it contraction, for
 * which panels are tried. */
#define MAX_CONTRACTION 0.3

/* Largest angle [rad] of the fastest oscillation in a panel. */
#define MAX_ARC 2.0

/* Share of the velocity, as Coulomb friction alone would have it, that must surely be left. */
#define SURE 0.1

enum { MAX_CORRECTIONS = 6 };

/* Share of the tolerance that ending the iteration may take. */
#define ITERATION_SHARE 0.1

/* What is known before any table: `rate` k [1/m] of E, `lag` rho [s], `bend` beta, and largest change of
 * velocity [m/s^2] by f (`push`), speed [m/s] and acceleration under full friction [m/s^2], both ahead. */
typedef struct {
    double rate, lag, bend, push, speed, acceleration;
} Bending;

/* Largest value of G', per 1 / M; NAN where G' may be negative within `length` [s]. */
static double response_bound(const Plant *plant, double length) {
    if (plant->mass_fraction == 0.0) {
        return 1.0;
    }
    const Oscillator *slip = &plant->slip;
    double share = plant->slider_mass / plant->total_mass;
    double swing = plant->mass_fraction * slip->frequency / slip->eigenvalue.im;
    if (swing >= share && slip->frequency * length > 0.5) {
        return NAN;
    }
    return share + swing;
}

/* Exponent of E from which on the impulse that is left changes the velocity by less than
 * `tolerance` [m/s]: below 0 from the start on. NAN where the slider may stop before. */
static double exponent_needed(const Bending *bending, double tolerance) {
    double path = GUESSED_EXPONENT / bending->rate;
    double square = bending->speed * bending->speed;
    double faster = square + 2.0 * bending->acceleration * path;
    double speed = faster > 0.25 * square ? sqrt(faster) : NAN;
    double time = 1.0 / (bending->rate * speed) + bending->lag;
    return log(bending->push * time / tolerance);
}

/* Time [s] for `path` [m], NAN if it is never travelled. */
static double time_for(const Bending *bending, double path) {
    double speed = bending->speed;
    return 2.0 * path / (speed + sqrt(speed * speed + 2.0 * bending->acceleration * path));
}

/* The same with the change of acceleration [m/s^3]. */
static double corrected_time(const Bending *bending, double path, double jerk, double t) {
    double speed = bending->speed + t * (bending->acceleration + 0.5 * t * jerk);
    double ahead = t * (bending->speed + t * (0.5 * bending->acceleration + t * jerk / 6.0)) - path;
    return speed > 0.0 ? t - ahead / speed : NAN;
}

/* Derivative of the acceleration at the start of a slide [m/s^3]. */
static double jerk_of(const SplitSlide *slide) {
    const Plant *plant = slide->plant;
    const Phasors *start = &slide->start.phasors;
    double w = plant->drive_frequency, q = plant->normal_frequency;
    Complex eigenvalue = plant->slip.eigenvalue;
    Complex square = complex_mul(eigenvalue, eigenvalue);
    double jerk = -w * w * complex_mul(slide->velocity_drive, start->drive).re;
    if (!slide->split->merges) {
        jerk -= q * q * complex_mul(slide->velocity_normal, start->normal).re;
    }
    if (plant->resolves_resonator) {
        jerk += complex_mul(square, slide->velocity_free).re;
    }
    return jerk;
}

/* Whether the slider surely does not stop within `length` [s]. A parabola is below the velocity of
 * Coulomb friction. f takes from it at most what comes with E' < 0, push rho (1 - E), with 1 - E at most
 * k times the path. */
static bool goes_on(const Bending *bending, const SplitSlide *slide, double length) {
    double bound = slide->bound + slide->free_bound;
    double drag = bending->push * bending->lag * bending->rate;
    double fastest = fmax(bending->acceleration, 0.0) + bending->push + bound * length;
    double gained = bending->speed + bending->acceleration * length;
    double lost = 0.5 * bound * length + drag * (bending->speed + 0.5 * fastest * length);
    return (bending->speed > 0.0 || bending->acceleration > 0.0) &&
           gained - lost * length > SURE * gained + slide->noise;
}

/* Friction limit [N] (re) and its derivative [N/s] (im) at a turn of the normal load. */
static Complex limit_at(const Plant *plant, Complex normal) {
    return complex_of(plant->friction_preload + plant->friction_amplitude * normal.im,
                      plant->friction_amplitude * plant->normal_frequency * normal.re);
}

/* exp(i chi) at the start of a slide. */
static Complex normal_at(const SplitSlide *slide) {
    const Phasors *start = &slide->start.phasors;
    return slide->plant->normal_frequency == slide->plant->drive_frequency
               ? complex_mul(start->drive, start->normal)
               : start->normal;
}

/* Exponents k |x - x_r| at the points, under full friction. */
static void full_friction(const SplitSlide *slide, const Bending *bending,
                          const BendingKernels *kernels, double exponent[POINTS]) {
    const Phasors *start = &slide->start.phasors;
    Complex drive = complex_mul(slide->velocity_drive, start->drive);
    Complex normal = complex_mul(slide->velocity_normal, start->normal);
    Complex free = slide->velocity_free;
    bool apart = !slide->split->merges;
    double scale = slide->direction * bending->rate;
    for (int i = 0; i < POINTS; i++) {
        double t = kernels->time[i];
        double travel = drive.re * kernels->drive[i].re - drive.im * kernels->drive[i].im;
        travel += free.re * kernels->free[i].re - free.im * kernels->free[i].im;
        if (apart) {
            travel += normal.re * kernels->normal[i].re - normal.im * kernels->normal[i].im;
        }
        exponent[i] = bending->rate * bending->speed * t +
                      scale * (travel + 0.5 * slide->k1 * t * t);
    }
}

/* exp(-x) for a small x, to rounding up to 0.05. */
static double shrunk(double x) {
    double tail = 1.0 / 24.0 - x * (1.0 / 120.0 - x * (1.0 / 720.0 - x * (1.0 / 5040.0)));
    return 1.0 - x * (1.0 - x * (0.5 - x * (1.0 / 6.0 - x * tail)));
}

/* Impulses a [N] and b [N s] per E at the points, and what they are made from. */
typedef struct {
    double even[POINTS], late[POINTS], unbent[POINTS], first;
    bool drags;
} Forces;

static void prepare_forces(Forces *forces, const SplitSlide *slide, const Bending *bending,
                           const BendingKernels *kernels, const double exponent[POINTS]) {
    Complex normal = normal_at(slide);
    double sign = slide->direction * bending->bend;
    forces->drags = bending->lag > 0.0;
    forces->first = sign * bending->lag * limit_at(slide->plant, normal).re;
    for (int i = 0; i < POINTS; i++) {
        Complex limit =
            limit_at(slide->plant, complex_mul(normal, kernels->normal_turn[i]));
        forces->even[i] = sign * (limit.re - bending->lag * limit.im);
        forces->late[i] = sign * bending->lag * limit.re;
        forces->unbent[i] = exp(-exponent[i]);
    }
}

static double dot(const double *a, const double *b) {
    double total[4] = {0.0};
    for (int i = 0; i < NODES; i += 4) {
        for (int k = 0; k < 4; k++) {
            total[k] += a[i + k] * b[i + k];
        }
    }
    return (total[0] + total[2]) + (total[1] + total[3]);
}

/* What the iteration ended with: E, a and b at the points, the displacements, and the contraction. */
typedef struct {
    double remaining[POINTS], even[POINTS], late[POINTS], contraction;
} Iterate;

/* Corrects E until the change of the velocity by another correction is below `tolerance` [m/s]; `weight`
 * [m/s] is the largest that f could bring. */
static bool iterate(Iterate *at, const Forces *forces, const BendingKernels *kernels, double scale,
                    double weight, double tolerance, double change[POINTS]) {
    double before[POINTS] = {0.0}, last = 1.0;
    for (int i = 0; i < POINTS; i++) {
        at->remaining[i] = forces->unbent[i];
        at->even[i] = forces->even[i] * at->remaining[i];
        at->late[i] = forces->late[i] * at->remaining[i];
    }
    for (int correction = 0; correction < MAX_CORRECTIONS; correction++) {
        double largest = 0.0;
        for (int i = 0; i < POINTS; i++) {
            double travel = dot(kernels->travel[i], at->even);
            if (forces->drags) {
                travel += dot(kernels->speed[i], at->late) - kernels->response[i] * forces->first;
            }
            double bent = scale * travel;
            double turned = fabs(bent - before[i]) * at->remaining[i];
            largest = turned > largest ? turned : largest;
            before[i] = bent;
            change[i] = travel;
        }
        if (!(largest < MAX_CONTRACTION)) {
            return false;
        }
        for (int i = 0; i < POINTS; i++) {
            double bent = before[i];
            at->remaining[i] = forces->unbent[i] * (fabs(bent) < 0.05 ? shrunk(bent) : exp(-bent));
            at->even[i] = forces->even[i] * at->remaining[i];
            at->late[i] = forces->late[i] * at->remaining[i];
        }
        double contraction = correction == 0 ? largest : fmin(1.0, largest / last);
        at->contraction = correction == 0 ? largest : at->contraction;
        last = largest;
        if (weight * largest * contraction <= tolerance) {
            return true;
        }
    }
    return false;
}

/* The estimated error of the velocity after the panel [m/s], by the last Legendre coefficients of E times
 * the friction limit: the square of what interpolation misses is lost in integrals up to the end, and
 * within the panel changes E by contraction. */
static double truncation(const Iterate *at, const Forces *forces, const GaussNodes *gauss,
                         double weight) {
    double missed = 0.0, largest = 0.0;
    for (int k = 0; k < 2; k++) {
        missed = fmax(missed, fabs(dot(gauss->last[k], at->even)));
    }
    for (int i = 0; i < POINTS; i++) {
        largest = fmax(largest, fabs(forces->even[i]));
    }
    double share = missed / largest;
    return weight * share * (share + at->contraction);
}

/* The motion after the panel, from impulses up to its end. */
static void change_slide(BendingPanel *panel, const Iterate *at, const Forces *forces) {
    const BendingKernels *kernels = panel->kernels;
    const Plant *plant = panel->slide.plant;
    Complex eigenvalue = plant->slip.eigenvalue, free = complex_of(0.0, 0.0);
    double gained = at->late[NODES] - forces->first;
    double impulse = dot(kernels->impulse, at->even) + gained;
    double lever = dot(kernels->lever, at->even) - dot(kernels->impulse, at->late) +
                   kernels->length * at->late[NODES];
    panel->momentum = impulse / plant->total_mass;
    panel->offset = -lever / plant->total_mass;
    if (plant->resolves_resonator) {
        for (int j = 0; j < NODES; j++) {
            Complex force = complex_of(at->even[j] + eigenvalue.re * at->late[j],
                                       eigenvalue.im * at->late[j]);
            free = complex_add(free, complex_mul(kernels->back[j], force));
        }
        double angle = -eigenvalue.im * kernels->length;
        double grown = at->late[NODES] * exp(-eigenvalue.re * kernels->length);
        free = complex_add(free, complex_rect(grown, angle));
        free.re -= forces->first;
    }
    double per_force = 1.0 / (plant->slider_mass * eigenvalue.im);
    panel->swing = complex_of(-free.im * per_force, free.re * per_force);
    panel->offset -= plant->mass_fraction * panel->swing.re;
    split_slide_change(&panel->slide, panel->momentum, panel->swing);
}

/* What can be told before the slide is set up; false where no panel serves. */
static bool prospects(Bending *bending, const Held *held, const Bristle *bristle, int direction,
                      const Moment *now, const Phasors *phasors) {
    const Plant *plant = &held->plant;
    double mu = bristle->coefficient;
    Complex holding = complex_mul(plant->holding_drive, phasors->drive);
    double needed = plant->spring * now->state.displacement + plant->damper * now->state.rate -
                    plant->load + holding.im;
    double resisting = friction_limit_by(plant, phasors);
    double limit = plant->friction_preload + fabs(plant->friction_amplitude);
    bending->rate = bristle->stiffness / mu;
    bending->lag = bristle->damping / bristle->stiffness;
    bending->bend = (mu - direction * now->bristle) / mu;
    bending->push = bending->bend * limit / plant->slider_mass;
    bending->speed = fabs(now->state.velocity);
    bending->acceleration = (direction * needed - resisting) / plant->slider_mass;
    double moving =
        bending->acceleration + 0.5 * bending->rate * bending->speed * bending->speed;
    return bending->bend > 0.0 && bending->bend <= 2.0 &&
           bending->push < MAX_CONTRACTION * moving;
}

BendingMotion bending_panel_begin(BendingPanel *panel, BendingTables *tables, const Held *held,
                                  const Bristle *bristle, int direction, const Moment *now,
                                  KnownPhasors *known, double longest, double tolerance) {
    const Plant *plant = &held->plant;
    double chi = now->psi + plant->phase;
    Bending bending;
    if (!held->splits || !(bristle->stiffness > 0.0)) {
        return BY_SERIES;
    }
    if (!known->known) {
        *known = (KnownPhasors){true, phasors_of(plant, now->theta, chi)};
    }
    if (!prospects(&bending, held, bristle, direction, now, &known->phasors)) {
        return BY_SERIES;
    }
    double exponent = exponent_needed(&bending, tolerance);
    if (exponent <= 0.0) {
        return AS_BENT;
    }
    double path = exponent / bending.rate;
    double length = time_for(&bending, path);
    if (!(length < longest && length * held->split.fastest < MAX_ARC)) {
        return BY_SERIES;
    }
    SplitSlide *slide = &panel->slide;
    split_slide_begin(slide, &held->split, plant, direction, &now->state, now->theta, chi,
                      &known->phasors, direction);
    length = LONGER * corrected_time(&bending, path, direction * jerk_of(slide), length);
    bending.push *= response_bound(plant, 2.0 * length);
    if (!(length < longest && length * held->split.fastest < MAX_ARC)) {
        return BY_SERIES;
    }
    const BendingKernels *kernels = bending_kernels_of(tables, plant, length);
    length = kernels->length;
    if (!(length <= longest && goes_on(&bending, slide, length))) {
        return BY_SERIES;
    }
    double exponents[POINTS], weight = bending.push * (0.5 * length + bending.lag);
    Forces forces;
    Iterate at;
    panel->kernels = kernels;
    panel->gauss = &tables->gauss;
    panel->length = length;
    full_friction(slide, &bending, kernels, exponents);
    prepare_forces(&forces, slide, &bending, kernels, exponents);
    if (!iterate(&at, &forces, kernels, direction * bending.rate, weight,
                 ITERATION_SHARE * tolerance, panel->change) ||
        !(truncation(&at, &forces, &tables->gauss, weight) <= tolerance)) {
        return BY_SERIES;
    }
    panel->reach = at.remaining[NODES] <= exp(-exponent) ? INFINITY : length;
    change_slide(panel, &at, &forces);
    return BY_PANEL;
}

/* Displacement by f after `t` [s] within the panel, interpolated between the points. */
static double change_at(const BendingPanel *panel, double t) {
    double place = t / panel->length, above = 0.0, below = panel->gauss->barycentric[POINTS] / place;
    for (int i = 0; i < POINTS; i++) {
        double distance = t - panel->kernels->time[i];
        if (distance == 0.0) {
            return panel->change[i];
        }
        double weight = panel->gauss->barycentric[i] * panel->length / distance;
        above += weight * panel->change[i];
        below += weight;
    }
    return above / below;
}

double bending_panel_travel(const BendingPanel *panel, double t) {
    double travel = split_slide_travel(&panel->slide, t);
    if (t >= panel->length) {
        return travel + panel->offset;
    }
    if (!(t > 0.0)) {
        return 0.0;
    }
    const Plant *plant = panel->slide.plant;
    Complex eigenvalue = plant->slip.eigenvalue;
    Complex grown = complex_rect(exp(eigenvalue.re * t), eigenvalue.im * t);
    grown.re -= 1.0;
    double later = panel->momentum * t - plant->mass_fraction * complex_mul(panel->swing, grown).re;
    return travel - later + change_at(panel, t);
}

State bending_panel_end(const BendingPanel *panel, double t, double *travel, KnownPhasors *known) {
    State state = split_slide_end(&panel->slide, t, travel, known);
    *travel += panel->offset;
    return state;
}
