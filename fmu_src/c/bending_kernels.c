#include "bending_kernels.h"

#include <math.h>

/* |z t| below which exp(z t) - 1 - z t is a series, and its terms. */
#define SOON 0.5
enum { TERMS = 16 };

static Complex complex_exp(Complex z) {
    return complex_rect(exp(z.re), z.im);
}

/* int (exp(z s) - 1) ds from 0 to t. */
static Complex grown_less_one(Complex z, double t) {
    Complex angle = complex_scale(t, z);
    if (complex_abs(angle) > SOON) {
        Complex bent = complex_sub(complex_exp(angle), complex_of(1.0 + angle.re, angle.im));
        return complex_div(bent, z);
    }
    Complex term = complex_scale(0.5, angle), total = term;
    for (int n = 3; n < TERMS; n++) {
        term = complex_scale(1.0 / n, complex_mul(term, angle));
        total = complex_add(total, term);
    }
    return complex_scale(t, total);
}

static void prepare_normal(BendingKernels *kernels, double frequency) {
    for (int i = 0; i < POINTS; i++) {
        double t = kernels->time[i];
        kernels->normal_turn[i] = complex_rect(1.0, frequency * t);
        kernels->normal[i] = grown_less_one(complex_of(0.0, frequency), t);
    }
    kernels->has_normal = true;
}

static void prepare(BendingKernels *kernels, const GaussNodes *gauss, const Plant *plant,
                    int step, double length) {
    Complex eigenvalue = plant->slip.eigenvalue, turned[POINTS], back[NODES];
    double per_mass = 1.0 / plant->total_mass;
    double swing = plant->mass_fraction / (plant->slider_mass * eigenvalue.im);
    kernels->step = step;
    kernels->length = length;
    for (int i = 0; i < POINTS; i++) {
        double t = i < NODES ? length * gauss->node[i] : length;
        Complex angle = complex_scale(t, eigenvalue);
        kernels->time[i] = t;
        kernels->drive[i] = grown_less_one(complex_of(0.0, plant->drive_frequency), t);
        kernels->free[i] = grown_less_one(eigenvalue, t);
        turned[i] = complex_exp(angle);
        kernels->response[i] = per_mass * t + swing * turned[i].im;
        if (i < NODES) {
            double weight = length * gauss->weight[i];
            back[i] = complex_exp(complex_scale(-1.0, angle));
            kernels->impulse[i] = weight;
            kernels->lever[i] = weight * t;
            kernels->back[i] = complex_scale(weight, back[i]);
        }
    }
    for (int i = 0; i < POINTS; i++) {
        for (int j = 0; j < NODES; j++) {
            Complex since = complex_mul(turned[i], back[j]);
            double weight = length * gauss->integral[i][j];
            double response =
                per_mass * (kernels->time[i] - kernels->time[j]) + swing * since.im;
            kernels->travel[i][j] = weight * response;
            kernels->speed[i][j] =
                weight * (per_mass + swing * complex_mul(eigenvalue, since).im);
        }
    }
    kernels->known = true;
}

/* Whether the tables are of this plant; normal frequency apart. */
static bool fit(const BendingTables *tables, const Plant *plant) {
    Complex eigenvalue = plant->slip.eigenvalue;
    return tables->prepared && tables->slider_mass == plant->slider_mass &&
           tables->total_mass == plant->total_mass &&
           tables->mass_fraction == plant->mass_fraction &&
           tables->drive_frequency == plant->drive_frequency &&
           tables->eigenvalue.re == eigenvalue.re && tables->eigenvalue.im == eigenvalue.im;
}

static void begin_anew(BendingTables *tables, const Plant *plant) {
    if (!tables->prepared) {
        gauss_nodes_prepare(&tables->gauss);
    }
    tables->prepared = true;
    tables->slider_mass = plant->slider_mass;
    tables->total_mass = plant->total_mass;
    tables->mass_fraction = plant->mass_fraction;
    tables->drive_frequency = plant->drive_frequency;
    tables->normal_frequency = plant->normal_frequency;
    tables->eigenvalue = plant->slip.eigenvalue;
    for (int i = 0; i < KEPT_LENGTHS; i++) {
        tables->kept[i].known = false;
    }
}

/* 2^(k / LENGTHS_PER_OCTAVE) / 2 for k from 1 on. */
static const double OCTAVE[LENGTHS_PER_OCTAVE] = {
    0.54525386633262884, 0.59460355750136051, 0.64841977732550483, 0.70710678118654757,
    0.77110541270397037, 0.84089641525371461, 0.91700404320467122, 1.0,
};

const BendingKernels *bending_kernels_of(BendingTables *tables, const Plant *plant, double length) {
    if (!fit(tables, plant)) {
        begin_anew(tables, plant);
    }
    if (tables->normal_frequency != plant->normal_frequency) {
        tables->normal_frequency = plant->normal_frequency;
        for (int i = 0; i < KEPT_LENGTHS; i++) {
            tables->kept[i].has_normal = false;
        }
    }
    double w = plant->drive_frequency;
    int exponent, place = 0;
    double share = frexp(length * w, &exponent);
    while (place < LENGTHS_PER_OCTAVE - 1 && OCTAVE[place] < share) {
        place++;
    }
    int step = LENGTHS_PER_OCTAVE * exponent + place;
    BendingKernels *kernels = &tables->kept[(unsigned)step % KEPT_LENGTHS];
    if (!kernels->known || kernels->step != step) {
        prepare(kernels, &tables->gauss, plant, step, ldexp(OCTAVE[place], exponent) / w);
        kernels->has_normal = false;
    }
    if (!kernels->has_normal) {
        prepare_normal(kernels, plant->normal_frequency);
    }
    return kernels;
}
