#include "bending_panel.h"

#include "elementary.h"
#include "fast_decay.h"

enum { MAX_CORRECTIONS = 6 };

/* Share of the tolerance for the error of the last iterate. */
#define ITERATION_SHARE 0.3

/* Change by a correction over the change by the one before, in units of the contraction. It is below 1
 * because f acts on the path only while E lasts, and later with each correction. */
#define NEXT 0.25

/* Friction limit [N] (re) and its derivative [N/s] (im) at a turn of the normal load. */
static Complex limit_at(const Plant *plant, Complex normal) {
    return complex_of(plant->friction_preload + plant->friction_amplitude * normal.im,
                      plant->friction_amplitude * plant->normal_frequency * normal.re);
}

static void add_swing(double *travel, Complex amplitude, const ComplexRow *row, int count) {
    for (int i = 0; i < count + 2; i++) {
        travel[i] += amplitude.re * row->re[i] - amplitude.im * row->im[i];
    }
}

/* k |x - x_r| at the points, under full friction. */
static void follow_path(const BendingPanel *panel, const BendingOutlook *outlook,
                        double *exponent) {
    const SplitSlide *slide = &panel->slide;
    const BendingKernels *kernels = panel->kernels;
    const Phasors *start = &slide->start.phasors;
    int count = kernels->gauss->count;
    double speed = slide->direction * outlook->speed, scale = slide->direction * outlook->rate;
    for (int i = 0; i < count + 2; i++) {
        double t = kernels->time[i];
        exponent[i] = (speed + 0.5 * slide->k1 * t) * t;
    }
    add_swing(exponent, complex_mul(slide->velocity_drive, start->drive), &kernels->drive, count);
    if (slide->plant->mass_fraction != 0.0) {
        Complex rate = complex_mul(slide->plant->slip.eigenvalue, slide->resonator_free);
        Complex recoil = complex_scale(-slide->plant->mass_fraction, rate);
        add_swing(exponent, recoil, &kernels->free, count);
    }
    if (!slide->split->merges) {
        Complex normal = complex_mul(slide->velocity_normal, start->normal);
        add_swing(exponent, normal, &kernels->normal, count);
    }
    for (int i = 0; i < count + 2; i++) {
        exponent[i] *= scale;
    }
}

/* a / E and b / E at the points. */
static void prepare_forces(BendingPanel *panel, double *even, double *late) {
    const BendingKernels *kernels = panel->kernels;
    const Plant *plant = panel->slide.plant;
    Complex normal = normal_phasor(plant, &panel->slide.start.phasors);
    panel->first = panel->scale * panel->lag * limit_at(plant, normal).re;
    for (int i = 0; i < kernels->gauss->count + 2; i++) {
        Complex turn = complex_of(kernels->turn.re[i], kernels->turn.im[i]);
        Complex limit = limit_at(plant, complex_mul(normal, turn));
        even[i] = panel->scale * (limit.re - panel->lag * limit.im);
        late[i] = panel->scale * panel->lag * limit.re;
    }
}

/* Adds the product of `matrix` and the forces at the nodes to `sum`. Constant numbers of nodes let a
 * compiler unroll the loops. */
static inline void add_products(double *restrict sum, double (*restrict matrix)[MAX_ROW],
                                const double *restrict forces, int nodes) {
    for (int j = 0; j < nodes; j++) {
        for (int i = 0; i < nodes + 2; i++) {
            sum[i] += matrix[j][i] * forces[j];
        }
    }
}

static void add_response(double *sum, double (*matrix)[MAX_ROW], const double *forces, int nodes) {
    switch (nodes) {
    case 8:
        add_products(sum, matrix, forces, 8);
        break;
    case 12:
        add_products(sum, matrix, forces, 12);
        break;
    case 16:
        add_products(sum, matrix, forces, 16);
        break;
    case 20:
        add_products(sum, matrix, forces, 20);
        break;
    default:
        add_products(sum, matrix, forces, MAX_NODES);
    }
}

/* Displacements [m] by f at the points. */
static void displace(const BendingPanel *panel, double change[MAX_ROW]) {
    BendingKernels *kernels = panel->kernels;
    int count = kernels->gauss->count;
    for (int i = 0; i < count + 2; i++) {
        change[i] = -kernels->response[i] * panel->first;
    }
    add_response(change, kernels->travel, panel->even, count);
    if (panel->lag > 0.0) {
        add_response(change, kernels->speed, panel->late, count);
    }
}

/* Contraction of the first correction, and E at the end (`left`); `done` where the iteration converged. */
typedef struct {
    bool done;
    double contraction, left;
} Iteration;

/* Corrects E and f, beginning with the path under full friction, until another correction would change the
 * velocity by less than `tolerance` [m/s]; `weight` [m/s] bounds the change by f. */
static Iteration iterate(BendingPanel *panel, const double *exponent, double weight,
                         double tolerance) {
    int count = panel->kernels->gauss->count;
    double even[MAX_ROW], late[MAX_ROW], bent[MAX_ROW], before[MAX_ROW] = {0.0};
    double remaining[MAX_ROW], scale = panel->slide.direction * panel->rate, next = 1.0;
    Iteration at = {false, 0.0, 1.0};
    prepare_forces(panel, even, late);
    for (int correction = 0; correction <= MAX_CORRECTIONS && at.contraction < 1.0; correction++) {
        for (int i = 0; i < count + 2; i++) {
            remaining[i] = fast_decay(exponent[i] + before[i]);
            panel->even[i] = even[i] * remaining[i];
            panel->late[i] = late[i] * remaining[i];
        }
        at.left = remaining[count];
        if (weight * next <= tolerance) {
            at.done = true;
            break;
        }
        double largest = 0.0;
        displace(panel, bent);
        for (int i = 0; i <= count; i++) {
            bent[i] *= scale;
            double turned = fabs(bent[i] - before[i]) * remaining[i];
            largest = turned > largest ? turned : largest;
            before[i] = bent[i];
        }
        at.contraction = correction == 0 ? largest : at.contraction;
        next = NEXT * largest * at.contraction;
    }
    return at;
}

/* Adds the integrals of the value `late` [N s] that b has at its end `t` [s]. */
static void add_end(const Plant *plant, double left[LEFT], double t, double late) {
    Complex eigenvalue = plant->slip.eigenvalue;
    Complex back = complex_rect(late * exp(-eigenvalue.re * t), -eigenvalue.im * t);
    left[IMPULSE] += late;
    left[LEVER] += t * late;
    left[BACK_RE] += back.re;
    left[BACK_IM] += back.im;
}

/* The integrals of f from those of forces at the nodes, without the value of b at the end. */
static void sum_up(const BendingPanel *panel, double (*even)[LEFT], double (*late)[LEFT],
                   double left[LEFT]) {
    int count = panel->kernels->gauss->count;
    left[IMPULSE] = left[BACK_RE] = -panel->first;
    left[LEVER] = left[BACK_IM] = 0.0;
    for (int j = 0; j < count; j++) {
        for (int k = 0; k < LEFT; k++) {
            left[k] += even[j][k] * panel->even[j];
        }
    }
    for (int j = 0; j < count && panel->lag > 0.0; j++) {
        for (int k = 0; k < LEFT; k++) {
            left[k] += late[j][k] * panel->late[j];
        }
    }
}

static Given given_by(const Plant *plant, const double left[LEFT]) {
    Given given = {-left[LEVER] / plant->total_mass, left[IMPULSE] / plant->total_mass, {0.0, 0.0}};
    if (plant->resolves_resonator) {
        double per_force = 1.0 / (plant->slider_mass * plant->slip.eigenvalue.im);
        given.swing = complex_of(-left[BACK_IM] * per_force, left[BACK_RE] * per_force);
        given.offset -= plant->mass_fraction * given.swing.re;
    }
    return given;
}

/* Turns the motion under full friction into that after the panel. */
static void end_panel(BendingPanel *panel) {
    BendingKernels *kernels = panel->kernels;
    int end = kernels->gauss->count;
    double left[LEFT];
    sum_up(panel, kernels->left_even, kernels->left_late, left);
    if (panel->late[end] != 0.0) {
        add_end(panel->slide.plant, left, panel->length, panel->late[end]);
    }
    panel->all = given_by(panel->slide.plant, left);
    split_slide_change(&panel->slide, panel->all.momentum, panel->all.swing);
    split_slide_anchor(&panel->slide, panel->length, kernels->end_drive,
                       complex_of(kernels->turn.re[end], kernels->turn.im[end]), kernels->end_free);
}

BendingMotion bending_panel_begin(BendingPanel *panel, BendingTables *tables, const Held *held,
                                  const Bristle *bristle, int direction, const Moment *now,
                                  const Phasors *start, double longest, double tolerance) {
    const Plant *plant = &held->plant;
    double chi = now->psi + plant->phase;
    bool swings = held->splits && plant->slip.oscillatory && !held->split.creeps;
    if (!swings || !(bristle->stiffness > 0.0)) {
        return BY_SERIES;
    }
    BendingOutlook outlook;
    BendingMotion motion =
        bending_outlook(&outlook, held, bristle, direction, now, start, longest, tolerance);
    if (motion != BY_PANEL) {
        return motion;
    }
    double length = outlook.length;
    bool ends_within = MAX_KERNELS_STEP * length > longest;
    int nodes = bending_nodes(&outlook, length, ends_within, tolerance);
    if (nodes == 0) {
        return BY_SERIES;
    }
    SplitSlide *slide = &panel->slide;
    split_slide_begin(slide, &held->split, plant, direction, &now->state, now->theta, chi, start,
                      direction);
    if (!bending_goes_on(&outlook, slide, MAX_KERNELS_STEP * length)) {
        return BY_SERIES;
    }
    BendingKernels *kernels = bending_kernels_of(tables, plant, length, nodes);
    panel->kernels = kernels;
    length = panel->length = kernels->length;
    panel->rate = outlook.rate;
    panel->scale = direction * outlook.bend;
    panel->lag = outlook.lag;
    double exponent[MAX_ROW], weight = bending_weight(&outlook, length);
    follow_path(panel, &outlook, exponent);
    Iteration at = iterate(panel, exponent, weight, ITERATION_SHARE * tolerance);
    double missed = gauss_nodes_last(kernels->gauss, panel->even);
    double share = missed / (plant->slider_mass * outlook.push);
    if (!at.done || !(bending_error(weight, share, at.contraction, nodes, length > longest) <=
                      tolerance)) {
        return BY_SERIES;
    }
    panel->reach = at.left <= fast_decay(outlook.exponent) ? INFINITY : length;
    end_panel(panel);
    return BY_PANEL;
}

/* The motion that goes on if f has given no more than `given`. */
static SplitSlide slide_with(const BendingPanel *panel, const Given *given) {
    SplitSlide slide = panel->slide;
    split_slide_change(&slide, given->momentum - panel->all.momentum,
                       complex_sub(given->swing, panel->all.swing));
    return slide;
}

/* The motion that goes on if f ends at `t` [s] within the panel; `offset` [m] is to be added to its
 * displacement. */
static SplitSlide slide_from(const BendingPanel *panel, double t, double *offset) {
    const BendingKernels *kernels = panel->kernels;
    const Plant *plant = panel->slide.plant;
    double integral[MAX_NODES], even[MAX_NODES][LEFT], late[MAX_NODES][LEFT], left[LEFT];
    gauss_nodes_integrate(kernels->gauss, t / panel->length, integral);
    for (int j = 0; j < kernels->gauss->count; j++) {
        Complex back = complex_of(kernels->back.re[j], kernels->back.im[j]);
        bending_left(plant->slip.eigenvalue, back, kernels->time[j], panel->length * integral[j],
                     even[j], late[j]);
    }
    sum_up(panel, even, late, left);
    Given given = given_by(plant, left);
    SplitSlide slide = slide_with(panel, &given);
    if (panel->lag > 0.0) {
        double travel = split_slide_travel(&slide, t) + given.offset;
        Complex normal = normal_phasor(plant, &panel->slide.start.phasors);
        Complex turned = complex_mul(normal, complex_rect(1.0, plant->normal_frequency * t));
        double limit = panel->scale * panel->lag * limit_at(plant, turned).re;
        add_end(plant, left, t, limit * fast_decay(panel->rate * fabs(travel)));
        given = given_by(plant, left);
        slide = slide_with(panel, &given);
    }
    *offset = given.offset;
    return slide;
}

double bending_panel_travel(const BendingPanel *panel, double t) {
    if (t >= panel->length) {
        return split_slide_travel(&panel->slide, t) + panel->all.offset;
    }
    double offset;
    SplitSlide slide = slide_from(panel, t, &offset);
    return split_slide_travel(&slide, t) + offset;
}

State bending_panel_end(const BendingPanel *panel, double t, double *travel, KnownPhasors *known) {
    double offset = panel->all.offset;
    State state;
    if (t >= panel->length) {
        state = split_slide_end(&panel->slide, t, travel, known);
    } else {
        SplitSlide slide = slide_from(panel, t, &offset);
        state = split_slide_end(&slide, t, travel, known);
    }
    *travel += offset;
    return state;
}
