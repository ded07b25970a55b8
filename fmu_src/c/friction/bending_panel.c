#include "bending_panel.h"

#include "../base/elementary.h"
#include "../base/fast_decay.h"

/* Exponent of E at which the decay of f is first estimated. */
#define GUESSED_EXPONENT 16.0

/* Share of the tolerance for the part of f after the panel, which is dropped. It is small because this error has the
 * same sign at each reversal, and adds up. */
#define LEFT_OUT 0.2

/* Safety factor on the estimated length of a panel. */
#define LONGER 1.05

/* Longest panel, as an angle [rad] of the fastest oscillation: the nodes follow that to rounding. */
#define MAX_ARC 2.0

/* Exponent of E that a panel must reach: series are as cheap for bristles that bend less, as in presliding. */
#define MIN_EXPONENT 5.0

/* Share of the interpolation error of f that appears in the displacement within the panel. */
#define DISPLACING 0.05

enum { MAX_CORRECTIONS = 6 };

/* Share of the tolerance for the error of the last iterate. */
#define ITERATION_SHARE 0.3

/* Change by a correction over the change by the one before, in units of the contraction. It is below 1 because f acts
 * on the path only while E lasts, and later with each correction. */
#define NEXT 0.25

/* What is known before any integration. `rate` k [1/m] of E = exp(-k |x - x_r|), `lag` rho [s], `bend` beta; `push`
 * bounds the acceleration by the force f of the bristle [m/s^2]; `speed` [m/s] and `acceleration` [m/s^2] are those
 * under full friction, in the direction of sliding. From E = exp(-`exponent`) on, after about `length` [s], f changes
 * the velocity by less than the tolerance. */
typedef struct {
    double rate, lag, bend, push, speed, acceleration, exponent, length;
} Outlook;

/* Chooses by the time in which the bristle bends. */
static BendingMotion look_out(Outlook *outlook, const System *system, int direction, const Moment *now,
                              const Phasors *phasors, double longest, double tolerance) {
    const Plant *plant = &system->plant;
    const Bristle *bristle = &system->bristle;
    double mu = bristle->coefficient, speed = fabs(now->state.velocity);
    double resisting = direction * friction_limit_by(plant, phasors);
    double force = direction * (force_by(plant, &now->state, phasors) - resisting);
    double limit = plant->friction_preload + plant->friction_amplitude;
    double reach = fmin(MAX_ARC / system->split.fastest, longest);
    outlook->rate = bristle->stiffness / mu;
    outlook->speed = speed;
    outlook->acceleration = force / plant->slider_mass;
    if (!(outlook->rate * reach * (speed + 0.5 * outlook->acceleration * reach) > MIN_EXPONENT)) {
        return BY_SERIES;
    }
    outlook->lag = bristle->damping / bristle->stiffness;
    outlook->bend = (mu - direction * now->bristle) / mu;
    outlook->push = outlook->bend * limit / plant->slider_mass;
    double path = GUESSED_EXPONENT / outlook->rate;
    double square = speed * speed + 2.0 * outlook->acceleration * path;
    if (!(outlook->bend > 0.0 && outlook->bend <= 2.0 && square > 0.25 * speed * speed)) {
        return BY_SERIES;
    }
    double time = 1.0 / (outlook->rate * sqrt(square)) + outlook->lag;
    outlook->exponent = log(outlook->push * time / (LEFT_OUT * tolerance));
    if (outlook->exponent <= 0.0) {
        return AS_BENT;
    }
    path = outlook->exponent / outlook->rate;
    double last = sqrt(fmax(speed * speed + 2.0 * outlook->acceleration * path, 0.0));
    double length = LONGER * 2.0 * path / (speed + last);
    outlook->length = fmin(length, longest / MAX_KERNELS_STEP);
    return MAX_KERNELS_STEP * length * system->split.fastest < MAX_ARC ? BY_PANEL : BY_SERIES;
}

/* Bound on G' over 1 / M within `length` [s]; NAN where G' may be negative. */
static double response_bound(const Plant *plant, double length) {
    const Oscillator *slip = &plant->slip;
    double share = plant->slider_mass / plant->total_mass;
    double swing = plant->mass_fraction * slip->frequency / slip->eigenvalue.im;
    return swing < share || slip->frequency * length < 0.5 ? share + swing : NAN;
}

/* Whether the slider is guaranteed not to stop for `length` [s].
 *
 * A parabola bounds the velocity under full friction from below. Of f only the part with E' < 0 decreases the velocity:
 * by push rho (1 - E), where 1 - E is at most k times the path. */
static bool goes_on(const Outlook *outlook, SplitSlide *slide, double length) {
    Watch watch = split_slide_watch(slide);
    double bound = watch.signal(watch.motion, 0.0).bound;
    double push = outlook->push * response_bound(slide->plant, length);
    double fastest = fmax(outlook->acceleration, 0.0) + push + bound * length;
    double gained = outlook->speed + outlook->acceleration * length;
    double path = (outlook->speed + 0.5 * fastest * length) * length;
    double lost = 0.5 * bound * length * length + push * outlook->lag * outlook->rate * path;
    return (outlook->speed > 0.0 || outlook->acceleration > 0.0) && isgreater(gained - lost, slide->noise);
}

/* Estimate of the error of the velocity [m/s] at the end of the panel: the nodes miss a `share` of f, which changes the
 * velocity by no more than `weight` [m/s].
 *
 * E is an entire function, so its Legendre coefficients fall ever faster. Integrals up to the end miss only those of
 * twice the order, which are below 2^(-nodes) times the square of the last one. */
static double error_of(double weight, double share, double contraction) {
    return weight * share * (DISPLACING * contraction + ldexp(share, -GAUSS_NODES / 2));
}

/* Friction limit [N] (re) and its derivative [N/s] (im) at a turn of the normal load. */
static Complex limit_at(const Plant *plant, Complex normal) {
    return complex_of(plant->friction_preload + plant->friction_amplitude * normal.im,
                      plant->friction_amplitude * plant->normal_frequency * normal.re);
}

static void add_swing(double *travel, Complex amplitude, const ComplexRow *row) {
    for (int i = 0; i < POINTS; i++) {
        travel[i] += amplitude.re * row->re[i] - amplitude.im * row->im[i];
    }
}

/* k |x - x_r| at the points, under full friction. */
static void follow_path(const BendingPanel *panel, const Outlook *outlook, double *exponent) {
    const SplitSlide *slide = &panel->slide;
    const BendingKernels *kernels = panel->kernels;
    const Phasors *start = &slide->start.phasors;
    double speed = slide->direction * outlook->speed, scale = slide->direction * outlook->rate;
    for (int i = 0; i < POINTS; i++) {
        double t = kernels->time[i];
        exponent[i] = (speed + 0.5 * slide->k1 * t) * t;
    }
    add_swing(exponent, complex_mul(slide->velocity_drive, start->drive), &kernels->drive);
    if (slide->plant->mass_fraction != 0.0) {
        Complex eigenvalue = slide->plant->slip.eigenvalue;
        Response free = slide->free_start;
        Complex swing = complex_of(free.displacement, -(free.rate - eigenvalue.re * free.displacement) / eigenvalue.im);
        Complex recoil = complex_scale(-slide->plant->mass_fraction, complex_mul(eigenvalue, swing));
        add_swing(exponent, recoil, &kernels->free);
    }
    if (!slide->split->merges) {
        Complex normal = complex_mul(slide->velocity_normal, start->normal);
        add_swing(exponent, normal, &kernels->normal);
    }
    for (int i = 0; i < POINTS; i++) {
        exponent[i] *= scale;
    }
}

/* a / E and b / E at the points. */
static void prepare_forces(BendingPanel *panel, double *even, double *late) {
    const BendingKernels *kernels = panel->kernels;
    const Plant *plant = panel->slide.plant;
    Complex normal = normal_phasor(plant, &panel->slide.start.phasors);
    panel->first = panel->scale * panel->lag * limit_at(plant, normal).re;
    for (int i = 0; i < POINTS; i++) {
        Complex turn = complex_of(kernels->turn.re[i], kernels->turn.im[i]);
        Complex limit = limit_at(plant, complex_mul(normal, turn));
        even[i] = panel->scale * (limit.re - panel->lag * limit.im);
        late[i] = panel->scale * panel->lag * limit.re;
    }
}

/* Adds the product of `matrix` and the forces at the nodes to `sum`. */
static void add_response(double *restrict sum, double (*restrict matrix)[POINTS], const double *restrict forces) {
    for (int j = 0; j < GAUSS_NODES; j++) {
        for (int i = 0; i < POINTS; i++) {
            sum[i] += matrix[j][i] * forces[j];
        }
    }
}

/* Displacements [m] by f at the points. */
static void displace(const BendingPanel *panel, double change[POINTS]) {
    BendingKernels *kernels = panel->kernels;
    for (int i = 0; i < POINTS; i++) {
        change[i] = -kernels->response[i] * panel->first;
    }
    add_response(change, kernels->travel, panel->even);
    if (panel->lag > 0.0) {
        add_response(change, kernels->speed, panel->late);
    }
}

/* Contraction of the first correction, and E at the end (`left`); `done` where the iteration converged. */
typedef struct {
    bool done;
    double contraction, left;
} Iteration;

/* Corrects E and f, beginning with the path under full friction, until another correction would change the velocity by
 * less than `tolerance` [m/s]; `weight` [m/s] bounds the change by f. */
static Iteration iterate(BendingPanel *panel, double weight, double tolerance) {
    double even[POINTS], late[POINTS], bent[POINTS], before[POINTS] = {0.0};
    double remaining[POINTS], scale = panel->slide.direction * panel->rate, next = 1.0;
    Iteration at = {false, 0.0, 1.0};
    prepare_forces(panel, even, late);
    for (int correction = 0; correction <= MAX_CORRECTIONS && at.contraction < 1.0; correction++) {
        for (int i = 0; i < POINTS; i++) {
            remaining[i] = fast_decay(panel->exponent[i] + before[i]);
            panel->even[i] = even[i] * remaining[i];
            panel->late[i] = late[i] * remaining[i];
        }
        at.left = remaining[END];
        if (weight * next <= tolerance) {
            at.done = true;
            break;
        }
        double largest = 0.0;
        displace(panel, bent);
        for (int i = 0; i <= END; i++) {
            bent[i] *= scale;
            double turned = fabs(bent[i] - before[i]) * remaining[i];
            largest = turned > largest ? turned : largest;
            before[i] = bent[i];
        }
        at.contraction = correction == 0 ? largest : at.contraction;
        next = NEXT * largest * at.contraction;
    }
    for (int i = 0; i <= END; i++) {
        panel->exponent[i] += before[i];
    }
    return at;
}

/* The integrals of f. */
static void sum_up(const BendingPanel *panel, double left[LEFT]) {
    const BendingKernels *kernels = panel->kernels;
    double t = panel->length, late = panel->late[END];
    Complex eigenvalue = panel->slide.plant->slip.eigenvalue;
    Complex back = complex_rect(late * exp(-eigenvalue.re * t), -eigenvalue.im * t);
    left[IMPULSE] = late - panel->first;
    left[LEVER] = t * late;
    left[BACK_RE] = back.re - panel->first;
    left[BACK_IM] = back.im;
    for (int j = 0; j < GAUSS_NODES; j++) {
        for (int k = 0; k < LEFT; k++) {
            left[k] += kernels->left_even[j][k] * panel->even[j] + kernels->left_late[j][k] * panel->late[j];
        }
    }
}

/* The power of friction at the nodes: the path over the time is a polynomial, and E' = -k |x'| E. */
void bending_panel_weigh(BendingPanel *panel) {
    const BendingKernels *kernels = panel->kernels;
    const Plant *plant = panel->slide.plant;
    Complex normal = normal_phasor(plant, &panel->slide.start.phasors);
    double mean[POINTS - 1], slope[GAUSS_NODES] = {0.0};
    for (int j = 0; j <= END; j++) {
        mean[j] = panel->exponent[j] / kernels->time[j];
        for (int i = 0; i < GAUSS_NODES; i++) {
            slope[i] += kernels->slope[j][i] * mean[j];
        }
    }
    for (int i = 0; i < GAUSS_NODES; i++) {
        double fading = mean[i] + kernels->time[i] * slope[i];
        Complex turn = complex_of(kernels->turn.re[i], kernels->turn.im[i]);
        double limit = limit_at(plant, complex_mul(normal, turn)).re;
        double bend = panel->slide.direction * panel->scale * fast_decay(panel->exponent[i]);
        double friction = limit * (1.0 - bend * (1.0 - panel->lag * fading));
        panel->power[i] = friction * fading / panel->rate;
    }
    panel->slide.works = true;
    panel->work = -split_slide_place(&panel->slide, panel->length).passed.work;
    for (int i = 0; i < GAUSS_NODES; i++) {
        panel->work += kernels->left_even[i][IMPULSE] * panel->power[i];
    }
}

/* Turns the motion under full friction into that after the panel. */
static void end_panel(BendingPanel *panel) {
    const BendingKernels *kernels = panel->kernels;
    const Plant *plant = panel->slide.plant;
    double left[LEFT];
    sum_up(panel, left);
    double momentum = left[IMPULSE] / plant->total_mass;
    Complex swing = complex_of(0.0, 0.0);
    if (plant->resolves_resonator) {
        double per_force = 1.0 / (plant->slider_mass * plant->slip.eigenvalue.im);
        swing = complex_of(-left[BACK_IM] * per_force, left[BACK_RE] * per_force);
    }
    panel->offset = -left[LEVER] / plant->total_mass - plant->mass_fraction * swing.re;
    split_slide_change(&panel->slide, momentum, swing);
    split_slide_anchor(&panel->slide, panel->length, kernels->end_drive,
                       complex_of(kernels->turn.re[END], kernels->turn.im[END]), kernels->end_free);
    panel->work = 0.0;
}

void bending_panel_skip(BendingPanel *panel, const Split *split, const Plant *plant, int direction, const Moment *now,
                        const Phasors *start) {
    split_slide_begin(&panel->slide, split, plant, now, start, direction);
    panel->length = panel->offset = panel->work = 0.0;
    panel->reach = INFINITY;
}

BendingMotion bending_panel_begin(BendingPanel *panel, const System *system, int direction, const Moment *now,
                                  const Phasors *start, double longest, double tolerance) {
    const Plant *plant = &system->plant;
    bool swings = system->splits && plant->slip.oscillatory && !is_ramped(plant);
    if (system->bending == NULL || !swings || !(system->bristle.stiffness > 0.0)) {
        return BY_SERIES;
    }
    Outlook outlook;
    BendingMotion motion = look_out(&outlook, system, direction, now, start, longest, tolerance);
    if (motion != BY_PANEL) {
        return motion;
    }
    SplitSlide *slide = &panel->slide;
    split_slide_begin(slide, &system->split, plant, now, start, direction);
    if (!goes_on(&outlook, slide, MAX_KERNELS_STEP * outlook.length)) {
        return BY_SERIES;
    }
    panel->kernels = bending_kernels_of(system->bending, plant, outlook.length);
    panel->length = panel->kernels->length;
    panel->rate = outlook.rate;
    panel->scale = direction * outlook.bend;
    panel->lag = outlook.lag;
    double weight = outlook.push * (0.5 * panel->length + outlook.lag);
    follow_path(panel, &outlook, panel->exponent);
    Iteration at = iterate(panel, weight, ITERATION_SHARE * tolerance);
    double missed = gauss_last(panel->kernels->gauss, panel->even);
    double share = missed / (plant->slider_mass * outlook.push);
    if (!at.done || !(error_of(weight, share, at.contraction) <= tolerance)) {
        return BY_SERIES;
    }
    panel->reach = at.left <= fast_decay(outlook.exponent) ? INFINITY : panel->length;
    end_panel(panel);
    return BY_PANEL;
}

/* Displacement [m] within the panel, by interpolation between start and points. */
static double travel_within(const BendingPanel *panel, double t) {
    const BendingKernels *kernels = panel->kernels;
    double sum = 0.0, weights = 0.0;
    for (int i = 0; i <= END; i++) {
        double apart = t - kernels->time[i];
        if (apart == 0.0) {
            return panel->slide.direction * panel->exponent[i] / panel->rate;
        }
        /* The path over the time has the same polynomial but one degree less. */
        double weight = kernels->interpolating[i] / apart;
        sum += weight * panel->exponent[i] / kernels->time[i];
        weights += weight;
    }
    return panel->slide.direction * t * sum / (weights * panel->rate);
}

Passage bending_panel_passage(const BendingPanel *panel, double t) {
    if (t >= panel->length) {
        return bending_panel_place(panel, t).passed;
    }
    Passage within = {travel_within(panel, t), 0.0};
    if (panel->slide.works) {
        within.work = panel->length * gauss_integral(panel->kernels->gauss, t / panel->length, panel->power);
    }
    return within;
}

Place bending_panel_place(const BendingPanel *panel, double t) {
    Place place = split_slide_place(&panel->slide, t);
    place.passed.travel += panel->offset;
    place.passed.work += panel->work;
    return place;
}
