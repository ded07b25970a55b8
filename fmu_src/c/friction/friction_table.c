#include "friction_table.h"

#include <stdbool.h>

#include "../base/elementary.h"
#include "../device/state.h"

enum { CHECKS = 5 };

/* Places in a panel, which stands for [-1, 1], where a polynomial is compared with the means. They crowd where
 * panels get thinner. */
static const double CHECKED[CHECKS] = {-0.99, -0.95, -0.85, -0.5, 0.35};

/* Error of the means that a panel may have where it is checked, as a share of mu or of the largest
 * mean on the panel where that is larger. */
#define MAX_ERROR 1e-8

/* Halvings of a panel after which it is taken as it is, a fraction 6e-8 of the whole. */
enum { MAX_HALVINGS = 24 };

/* Chebyshev nodes of [-1, 1], and their barycentric weights. */
static const double NODE[TABLE_NODES] = {
    0.984807753012208, 0.8660254037844387, 0.6427876096865394,
    0.3420201433256688, 0.0, -0.3420201433256685,
    -0.6427876096865394, -0.8660254037844385, -0.984807753012208,
};
static const double WEIGHT[TABLE_NODES] = {
    0.17364817766693033, -0.49999999999999994, 0.766044443118978,
    -0.9396926207859083, 1.0, -0.9396926207859084,
    0.766044443118978, -0.5000000000000003, 0.17364817766693028,
};

/* The polynomials through the means at the nodes, at `x`, by the barycentric formula. */
static FrictionMeans panel_at(const FrictionMeans *panel, double x) {
    FrictionMeans sum = {0.0, 0.0, 0.0};
    double weights = 0.0;
    for (int j = 0; j < TABLE_NODES; j++) {
        double apart = x - NODE[j];
        if (apart == 0.0) {
            return panel[j];
        }
        double weight = WEIGHT[j] / apart;
        sum.plain += weight * panel[j].plain;
        sum.sine += weight * panel[j].sine;
        sum.cosine += weight * panel[j].cosine;
        weights += weight;
    }
    return (FrictionMeans){sum.plain / weights, sum.sine / weights, sum.cosine / weights};
}

static FrictionMeans means_in(const TabulatedMeans *table, double low, double high, double x) {
    double turning = 0.5 * (low + high + (high - low) * x);
    return table->friction->means(&table->bristle, &table->fast, table->n, turning);
}

static double largest(FrictionMeans means) {
    return fmax(fabs(means.plain), fmax(fabs(means.sine), fabs(means.cosine)));
}

/* Fills panels from `low` to `high` [rad], which were made by `halvings` of the whole. */
static void fill(TabulatedMeans *table, double low, double high, int halvings) {
    FrictionMeans *panel = table->panel[table->panels];
    double size = table->bristle.coefficient, error = 0.0;
    for (int j = 0; j < TABLE_NODES; j++) {
        panel[j] = means_in(table, low, high, NODE[j]);
        size = fmax(size, largest(panel[j]));
    }
    for (int i = 0; i < CHECKS; i++) {
        FrictionMeans found = panel_at(panel, CHECKED[i]);
        FrictionMeans means = means_in(table, low, high, CHECKED[i]);
        FrictionMeans missed = {found.plain - means.plain, found.sine - means.sine,
                                found.cosine - means.cosine};
        error = fmax(error, largest(missed));
    }
    /* As many halves as there were halvings may still have to be filled. */
    bool full = table->panels + halvings + 2 > MAX_PANELS;
    if (error > MAX_ERROR * size && halvings < MAX_HALVINGS && !full) {
        double middle = 0.5 * (low + high);
        fill(table, low, middle, halvings + 1);
        fill(table, middle, high, halvings + 1);
    } else {
        table->ends[++table->panels] = high;
    }
}

static bool holds(const TabulatedMeans *table, const AveragedFriction *friction,
                  const Bristle *bristle, const FastMotion *fast, double n) {
    return table->panels > 0 && table->friction == friction && table->n == n &&
           table->bristle.coefficient == bristle->coefficient &&
           table->bristle.stiffness == bristle->stiffness &&
           table->bristle.damping == bristle->damping &&
           table->fast.velocity == fast->velocity && table->fast.frequency == fast->frequency;
}

const TabulatedMeans *friction_table_of(FrictionTable *table, const AveragedFriction *friction,
                                        const Bristle *bristle, const FastMotion *fast, double n) {
    for (int i = 0; i < TABLES; i++) {
        if (holds(&table->tables[i], friction, bristle, fast, n)) {
            return &table->tables[i];
        }
    }
    TabulatedMeans *means = &table->tables[table->next];
    table->next = (table->next + 1) % TABLES;
    means->friction = friction;
    means->bristle = *bristle;
    means->fast = *fast;
    means->n = n;
    means->panels = 0;
    means->ends[0] = 0.0;
    fill(means, 0.0, 0.5 * PI, 0);
    return means;
}

FrictionMeans tabulated_means_at(const TabulatedMeans *table, double turning) {
    bool back = turning > 0.5 * PI;
    double angle = back ? PI - turning : turning;
    int k = 0;
    while (k < table->panels - 1 && !(angle < table->ends[k + 1])) {
        k++;
    }
    double low = table->ends[k], high = table->ends[k + 1];
    FrictionMeans means = panel_at(table->panel[k], (2.0 * angle - low - high) / (high - low));
    if (back) {
        double mirrored = fmod(table->n, 2.0) == 0.0 ? -1.0 : 1.0;
        means.plain = -means.plain;
        means.sine *= mirrored;
        means.cosine *= mirrored;
    }
    return means;
}
