#include "friction_table.h"

#include <string.h>

/* Last Legendre coefficients that a panel may have, as a share of mu or of the largest mean on the panel where that is
 * larger. */
#define MAX_ERROR 1e-8

/* Halvings of a panel after which it is taken as it is, a fraction 6e-8 of the whole. */
enum { MAX_HALVINGS = 24 };

/* Fills panels from `low` to `high` [rad], which were made by `halvings` of the whole. */
static void fill(FrictionTable *table, const GaussIntegrals *gauss, double low, double high, int halvings) {
    double values[MEANS][GAUSS_NODES], size = table->key.bristle.coefficient, error = 0.0;
    for (int j = 0; j < GAUSS_NODES; j++) {
        double means[MEANS], turning = 0.5 * (low + high + (high - low) * GAUSS_NODE[j]);
        friction_means(&table->key.bristle, &table->key.fast, table->key.n, turning, means);
        for (int i = 0; i < MEANS; i++) {
            values[i][j] = means[i];
            size = fmax(size, fabs(means[i]));
        }
    }
    for (int i = 0; i < MEANS; i++) {
        error = fmax(error, gauss_last(gauss, values[i]));
    }
    /* As many halves as there were halvings may still have to be filled. */
    bool full = table->panels + halvings + 2 > MAX_PANELS;
    if (error > MAX_ERROR * size && halvings < MAX_HALVINGS && !full) {
        double middle = 0.5 * (low + high);
        fill(table, gauss, low, middle, halvings + 1);
        fill(table, gauss, middle, high, halvings + 1);
        return;
    }
    for (int i = 0; i < MEANS; i++) {
        gauss_coefficients(gauss, values[i], table->panel[table->panels][i]);
    }
    table->ends[++table->panels] = high;
}

const FrictionTable *friction_table_of(FrictionTables *tables, const Bristle *bristle, const FastMotion *fast,
                                       double n) {
    MeansKey key = {*bristle, *fast, n};
    for (int i = 0; i < TABLES; i++) {
        if (memcmp(&tables->tables[i].key, &key, sizeof key) == 0) {
            return &tables->tables[i];
        }
    }
    FrictionTable *table = &tables->tables[tables->next];
    tables->next = (tables->next + 1) % TABLES;
    table->key = key;
    table->panels = 0;
    gauss_integrals_prepare(&tables->gauss);
    fill(table, &tables->gauss, 0.0, 0.5 * PI, 0);
    return table;
}

void tabulated_means(const FrictionTable *table, double turning, double means[MEANS]) {
    bool back = turning > 0.5 * PI;
    double angle = back ? PI - turning : turning;
    int k = 0;
    while (k < table->panels - 1 && !(angle < table->ends[k + 1])) {
        k++;
    }
    double low = table->ends[k], high = table->ends[k + 1], polynomials[GAUSS_NODES + 1];
    legendre((2.0 * angle - low - high) / (high - low), polynomials);
    double mirrored = fmod(table->key.n, 2.0) == 0.0 ? -1.0 : 1.0;
    for (int i = 0; i < MEANS; i++) {
        double sum = 0.0;
        for (int j = 0; j < GAUSS_NODES; j++) {
            sum += table->panel[k][i][j] * polynomials[j];
        }
        means[i] = back ? sum * (i == PLAIN ? -1.0 : mirrored) : sum;
    }
}
