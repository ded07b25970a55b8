#include "bending_kernels.h"

#include <string.h>

#include "../base/elementary.h"

static void put(ComplexRow *row, int i, Complex z) {
    row->re[i] = z.re;
    row->im[i] = z.im;
}

/* exp(z t), and int (exp(z s) - 1) ds from 0 to t. */
static Complex grow(Complex z, double t, Complex *integral) {
    Complex angle = complex_scale(t, z);
    Growth growth = growth_of(angle);
    *integral = complex_scale(t, complex_mul(angle, growth.twice));
    return growth.grown;
}

static void prepare_normal(BendingKernels *kernels, double frequency) {
    for (int i = 0; i < POINTS; i++) {
        Complex integral;
        put(&kernels->turn, i, grow(complex_of(0.0, frequency), kernels->time[i], &integral));
        put(&kernels->normal, i, integral);
    }
    kernels->normal_frequency = frequency;
}

/* The integrals of a unit force a and of a unit impulse b at a node. */
static void prepare_left(BendingKernels *kernels, Complex eigenvalue, Complex back, int node, double weight) {
    double *even = kernels->left_even[node], *late = kernels->left_late[node];
    Complex turned = complex_scale(weight, complex_mul(eigenvalue, back));
    even[IMPULSE] = weight;
    even[LEVER] = weight * kernels->time[node];
    even[BACK_RE] = weight * back.re;
    even[BACK_IM] = weight * back.im;
    late[IMPULSE] = 0.0;
    late[LEVER] = -weight;
    late[BACK_RE] = turned.re;
    late[BACK_IM] = turned.im;
}

static void prepare_interpolation(BendingKernels *kernels) {
    for (int i = 0; i <= END; i++) {
        double product = 1.0;
        for (int j = 0; j <= END; j++) {
            product *= i == j ? 1.0 : 4.0 * (kernels->time[i] - kernels->time[j]) / kernels->length;
        }
        kernels->interpolating[i] = 1.0 / product;
    }
    for (int i = 0; i < GAUSS_NODES; i++) {
        double sum = 0.0;
        for (int j = 0; j <= END; j++) {
            if (j != i) {
                double share = kernels->interpolating[j] / kernels->interpolating[i];
                kernels->slope[j][i] = share / (kernels->time[i] - kernels->time[j]);
                sum += kernels->slope[j][i];
            }
        }
        kernels->slope[i][i] = -sum;
    }
}

static void prepare(BendingKernels *kernels, const GaussIntegrals *gauss, const Plant *plant, double length) {
    Complex eigenvalue = plant->slip.eigenvalue, turned[POINTS], back[POINTS];
    double w = plant->drive_frequency;
    double per_mass = 1.0 / plant->total_mass;
    double swing = plant->mass_fraction / (plant->slider_mass * eigenvalue.im);
    kernels->gauss = gauss;
    kernels->normal_frequency = NAN;
    kernels->length = length;
    for (int i = 0; i < POINTS; i++) {
        double t = i < END ? 0.5 * length * (1.0 + GAUSS_NODE[i]) : length;
        Complex integral;
        kernels->end_drive = grow(complex_of(0.0, w), t, &integral);
        put(&kernels->drive, i, integral);
        turned[i] = grow(eigenvalue, t, &integral);
        put(&kernels->free, i, integral);
        back[i] = complex_div(complex_of(1.0, 0.0), turned[i]);
        kernels->time[i] = t;
        kernels->response[i] = per_mass * t + swing * turned[i].im;
    }
    for (int i = 0; i < POINTS; i++) {
        for (int j = 0; j < GAUSS_NODES; j++) {
            Complex since = complex_mul(turned[i], back[j]);
            double weight = length * gauss->integral[i < END ? i : END][j];
            double ago = kernels->time[i] - kernels->time[j];
            double slope = per_mass + swing * complex_mul(eigenvalue, since).im;
            kernels->travel[j][i] = weight * (per_mass * ago + swing * since.im);
            kernels->speed[j][i] = weight * slope;
        }
    }
    for (int j = 0; j < GAUSS_NODES; j++) {
        prepare_left(kernels, eigenvalue, back[j], j, length * gauss->integral[END][j]);
    }
    prepare_interpolation(kernels);
    kernels->end_free = turned[END];
}

BendingKernels *bending_kernels_of(BendingTables *tables, const Plant *plant, double length) {
    PlantKey key_of_plant = {plant->slider_mass, plant->total_mass, plant->mass_fraction, plant->drive_frequency,
                             plant->slip.eigenvalue};
    if (memcmp(&tables->plant, &key_of_plant, sizeof key_of_plant) != 0) {
        tables->plant = key_of_plant;
        tables->kept_count = tables->next = 0;
        gauss_integrals_prepare(&tables->gauss);
    }
    double w = plant->drive_frequency;
    int key = (int)ceil(log(length * w) / LENGTH_STEP), place = 0;
    while (place < tables->kept_count && tables->key[place] != key) {
        place++;
    }
    if (place == tables->kept_count) {
        place = tables->next;
        tables->next = (place + 1) % KEPT_KERNELS;
        tables->kept_count += tables->kept_count < KEPT_KERNELS;
        tables->key[place] = key;
        prepare(&tables->kept[place], &tables->gauss, plant, exp(key * LENGTH_STEP) / w);
    }
    BendingKernels *kernels = &tables->kept[place];
    if (kernels->normal_frequency != plant->normal_frequency) {
        prepare_normal(kernels, plant->normal_frequency);
    }
    return kernels;
}
