#include "friction_table.h"

#include <stdbool.h>

#include "elementary.h"
#include "state.h"

enum { TABLE_NODES = TABLE_DEGREE + 1, CHECKS = 4 };

/* Places in a panel, which stands for [-1, 1], where a polynomial is compared with the means. */
static const double CHECKED[CHECKS] = {-0.95, -0.85, -0.5, 0.35};

/* Error of the means that a panel may have where it is checked, as a share of mu or of the largest
 * mean on the panel where that is larger. */
#define MAX_ERROR 1e-8

/* Halvings of a panel after which it is taken as it is, a fraction 6e-8 of the whole. */
enum { MAX_HALVINGS = 24 };

/* Places in a panel at which the means are taken; row k of the weights gives the coefficient of the
 * k-th highest power from the values there. */
typedef struct {
    double node[TABLE_NODES], weight[TABLE_NODES][TABLE_NODES];
} Interpolation;

/* A panel still to be made, and how often the whole was halved for it. */
typedef struct {
    int halvings;
    double low, high;
} Part;

static double polynomial_at(const MeanPolynomial *polynomial, double x) {
    double total = polynomial->coefficient[0];
    for (int k = 1; k <= TABLE_DEGREE; k++) {
        total = total * x + polynomial->coefficient[k];
    }
    return total;
}

static FrictionMeans panel_at(const FrictionPanel *panel, double x) {
    return (FrictionMeans){polynomial_at(&panel->plain, x), polynomial_at(&panel->sine, x),
                           polynomial_at(&panel->cosine, x)};
}

static FrictionMeans means_in(const TabulatedMeans *table, const Part *part, double x) {
    double turning = 0.5 * (part->low + part->high + (part->high - part->low) * x);
    return table->friction->means(&table->bristle, &table->fast, table->n, turning);
}

static double largest(FrictionMeans means) {
    return fmax(fabs(means.plain), fmax(fabs(means.sine), fabs(means.cosine)));
}

/* Error of the polynomials at `x`. */
static double error_at(const FrictionPanel *panel, const TabulatedMeans *table, const Part *part,
                       double x) {
    FrictionMeans error = panel_at(panel, x), means = means_in(table, part, x);
    error.plain -= means.plain;
    error.sine -= means.sine;
    error.cosine -= means.cosine;
    return largest(error);
}

/* Place in a panel where the backward path is about mu / sigma_0 long: hard bristles bend there, and
 * those without stiffness nowhere. */
static double layer_in(const TabulatedMeans *table, const Part *part) {
    if (table->bristle.stiffness == 0.0) {
        return INFINITY;
    }
    double length = table->bristle.coefficient * table->fast.frequency /
                    (table->bristle.stiffness * table->fast.velocity);
    return (2.0 * pow(length, 1.0 / 3.0) - part->low - part->high) / (part->high - part->low);
}

static Interpolation interpolation(void) {
    Interpolation rule;
    for (int j = 0; j < TABLE_NODES; j++) {
        rule.node[j] = cos(PI * (j + 0.5) / (double)TABLE_NODES);
    }
    for (int j = 0; j < TABLE_NODES; j++) {
        /* The Lagrange polynomial of this node, by multiplying out its roots. */
        double polynomial[TABLE_NODES] = {1.0}, scale = 1.0;
        int degree = 0;
        for (int i = 0; i < TABLE_NODES; i++) {
            if (i == j) {
                continue;
            }
            degree++;
            for (int k = degree; k > 0; k--) {
                polynomial[k] -= rule.node[i] * polynomial[k - 1];
            }
            scale *= rule.node[j] - rule.node[i];
        }
        for (int k = 0; k < TABLE_NODES; k++) {
            rule.weight[k][j] = polynomial[k] / scale;
        }
    }
    return rule;
}

/* Interpolates the means on a panel; returns the largest relative error where it is checked. */
static double panel_make(FrictionPanel *panel, const TabulatedMeans *table,
                         const Interpolation *rule, const Part *part) {
    FrictionPanel made = {{{0.0}}, {{0.0}}, {{0.0}}};
    double size = table->bristle.coefficient, error = 0.0, layer = layer_in(table, part);
    for (int j = 0; j < TABLE_NODES; j++) {
        FrictionMeans means = means_in(table, part, rule->node[j]);
        size = fmax(size, largest(means));
        for (int k = 0; k < TABLE_NODES; k++) {
            made.plain.coefficient[k] += rule->weight[k][j] * means.plain;
            made.sine.coefficient[k] += rule->weight[k][j] * means.sine;
            made.cosine.coefficient[k] += rule->weight[k][j] * means.cosine;
        }
    }
    for (int check = 0; check < CHECKS; check++) {
        error = fmax(error, error_at(&made, table, part, CHECKED[check]));
    }
    if (-1.0 < layer && layer < 1.0) {
        error = fmax(error, error_at(&made, table, part, layer));
    }
    *panel = made;
    return error / size;
}

static void fill(TabulatedMeans *table) {
    Part todo[MAX_HALVINGS + 1] = {{0, 0.0, 0.5 * PI}};
    Interpolation rule = interpolation();
    int waiting = 1;
    table->panels = 0;
    table->ends[0] = 0.0;
    while (waiting > 0) {
        Part part = todo[--waiting];
        double error = panel_make(&table->panel[table->panels], table, &rule, &part);
        bool full = table->panels + waiting + 1 >= MAX_PANELS;
        if (error > MAX_ERROR && part.halvings < MAX_HALVINGS && !full) {
            double middle = 0.5 * (part.low + part.high);
            todo[waiting++] = (Part){part.halvings + 1, middle, part.high};
            todo[waiting++] = (Part){part.halvings + 1, part.low, middle};
        } else {
            table->ends[++table->panels] = part.high;
        }
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
    fill(means);
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
    FrictionMeans means = panel_at(&table->panel[k], (2.0 * angle - low - high) / (high - low));
    if (back) {
        double mirrored = fmod(table->n, 2.0) == 0.0 ? -1.0 : 1.0;
        means.plain = -means.plain;
        means.sine *= mirrored;
        means.cosine *= mirrored;
    }
    return means;
}
