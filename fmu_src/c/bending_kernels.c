#include "bending_kernels.h"

#include <math.h>

/* |z t| up to which exp(z t) - 1 - z t is summed as a series, and the terms of that. */
#define SOON 0.25
enum { TERMS = 12 };

static const double INVERSE[TERMS] = {
    0.0,     1.0,     1.0 / 2, 1.0 / 3, 1.0 / 4,  1.0 / 5,
    1.0 / 6, 1.0 / 7, 1.0 / 8, 1.0 / 9, 1.0 / 10, 1.0 / 11,
};

static void put(ComplexRow *row, int i, Complex z) {
    row->re[i] = z.re;
    row->im[i] = z.im;
}

/* exp(z t), and int (exp(z s) - 1) ds from 0 to t. */
static Complex grow(Complex z, double t, Complex *integral) {
    Complex angle = complex_scale(t, z);
    if (complex_abs(angle) > SOON) {
        Complex grown = complex_rect(exp(angle.re), angle.im);
        Complex bent = complex_sub(grown, complex_of(1.0 + angle.re, angle.im));
        *integral = complex_div(bent, z);
        return grown;
    }
    Complex term = complex_scale(0.5, angle), total = term;
    for (int n = 3; n < TERMS; n++) {
        term = complex_scale(INVERSE[n], complex_mul(term, angle));
        total = complex_add(total, term);
    }
    *integral = complex_scale(t, total);
    Complex bent = complex_mul(angle, total);
    return complex_of(1.0 + angle.re + bent.re, angle.im + bent.im);
}

static void prepare_normal(BendingKernels *kernels, double frequency) {
    for (int i = 0; i < kernels->gauss->count + 2; i++) {
        Complex integral;
        put(&kernels->turn, i, grow(complex_of(0.0, frequency), kernels->time[i], &integral));
        put(&kernels->normal, i, integral);
    }
    kernels->has_normal = true;
}

void bending_left(Complex eigenvalue, Complex back, double time, double weight, double even[LEFT],
                  double late[LEFT]) {
    Complex turned = complex_scale(weight, complex_mul(eigenvalue, back));
    even[IMPULSE] = weight;
    even[LEVER] = weight * time;
    even[BACK_RE] = weight * back.re;
    even[BACK_IM] = weight * back.im;
    late[IMPULSE] = 0.0;
    late[LEVER] = -weight;
    late[BACK_RE] = turned.re;
    late[BACK_IM] = turned.im;
}

static void prepare(BendingKernels *kernels, const GaussNodes *gauss, const Plant *plant,
                    double length) {
    Complex eigenvalue = plant->slip.eigenvalue, turned[MAX_ROW], back[MAX_ROW];
    double w = plant->drive_frequency;
    double per_mass = 1.0 / plant->total_mass;
    double swing = plant->mass_fraction / (plant->slider_mass * eigenvalue.im);
    int count = gauss->count;
    kernels->gauss = gauss;
    kernels->has_normal = false;
    kernels->length = length;
    for (int i = 0; i < count + 2; i++) {
        double t = i < count ? length * gauss->node[i] : length;
        Complex integral;
        kernels->end_drive = grow(complex_of(0.0, w), t, &integral);
        put(&kernels->drive, i, integral);
        turned[i] = grow(eigenvalue, t, &integral);
        put(&kernels->free, i, integral);
        back[i] = complex_div(complex_of(1.0, 0.0), turned[i]);
        kernels->time[i] = t;
        kernels->response[i] = per_mass * t + swing * turned[i].im;
        put(&kernels->back, i, back[i]);
    }
    for (int i = 0; i < count + 2; i++) {
        for (int j = 0; j < count; j++) {
            Complex since = complex_mul(turned[i], back[j]);
            double weight = length * gauss->integral[i < count ? i : count][j];
            double ago = kernels->time[i] - kernels->time[j];
            double slope = per_mass + swing * complex_mul(eigenvalue, since).im;
            kernels->travel[j][i] = weight * (per_mass * ago + swing * since.im);
            kernels->speed[j][i] = weight * slope;
        }
    }
    for (int j = 0; j < count; j++) {
        double weight = length * gauss->weight[j];
        bending_left(eigenvalue, back[j], kernels->time[j], weight, kernels->left_even[j],
                     kernels->left_late[j]);
    }
    kernels->end_free = turned[count];
}

/* Whether the tables are those of this plant, at any normal frequency. */
static bool fit(const BendingTables *tables, const Plant *plant) {
    Complex eigenvalue = plant->slip.eigenvalue;
    return tables->slider_mass == plant->slider_mass &&
           tables->total_mass == plant->total_mass &&
           tables->mass_fraction == plant->mass_fraction &&
           tables->drive_frequency == plant->drive_frequency &&
           tables->eigenvalue.re == eigenvalue.re && tables->eigenvalue.im == eigenvalue.im;
}

static void begin_anew(BendingTables *tables, const Plant *plant) {
    tables->slider_mass = plant->slider_mass;
    tables->total_mass = plant->total_mass;
    tables->mass_fraction = plant->mass_fraction;
    tables->drive_frequency = plant->drive_frequency;
    tables->normal_frequency = plant->normal_frequency;
    tables->eigenvalue = plant->slip.eigenvalue;
    for (int i = 0; i < KEPT_KERNELS; i++) {
        tables->key[i] = 0;
    }
}

static const GaussNodes *gauss_of(BendingTables *tables, int nodes) {
    GaussNodes *gauss = &tables->gauss[(nodes - MIN_NODES) / NODES_STEP];
    if (gauss->count == 0) {
        gauss_nodes_prepare(gauss, nodes);
    }
    return gauss;
}

/* 2^((k + 1) / LENGTHS_PER_OCTAVE) / 2. */
static const double OCTAVE[LENGTHS_PER_OCTAVE] = {
    0.5452538663326288, 0.5946035575013605, 0.6484197773255048, 0.7071067811865476,
    0.7711054127039704, 0.8408964152537145, 0.9170040432046712, 1.0,
};

BendingKernels *bending_kernels_of(BendingTables *tables, const Plant *plant, double length,
                                   int nodes) {
    if (!fit(tables, plant)) {
        begin_anew(tables, plant);
    }
    if (tables->normal_frequency != plant->normal_frequency) {
        tables->normal_frequency = plant->normal_frequency;
        for (int i = 0; i < KEPT_KERNELS; i++) {
            tables->kept[i].has_normal = false;
        }
    }
    double w = plant->drive_frequency;
    int exponent, part = 0;
    double share = frexp(length * w, &exponent);
    while (OCTAVE[part] < share) {
        part++;
    }
    int key = (LENGTHS_PER_OCTAVE * exponent + part) * (MAX_NODES + 1) + nodes;
    int place = 0;
    while (place < KEPT_KERNELS && tables->key[place] != key) {
        place++;
    }
    if (place == KEPT_KERNELS) {
        place = tables->oldest;
        tables->oldest = (place + 1) % KEPT_KERNELS;
        tables->key[place] = key;
        prepare(&tables->kept[place], gauss_of(tables, nodes), plant,
                ldexp(OCTAVE[part], exponent) / w);
    }
    BendingKernels *kernels = &tables->kept[place];
    if (!kernels->has_normal) {
        prepare_normal(kernels, plant->normal_frequency);
    }
    return kernels;
}
