/* Panels of bending bristles of the native component, for tests: numbers in, numbers out. */
#include <math.h>
#include <stdbool.h>
#include <stddef.h>

#include "base/fast_decay.h"
#include "base/gauss_nodes.h"
#include "friction/bending_panel.h"
#include "resolved/motion.h"
#include "component/parameter_values.h"

static bool system_of(System *system, const double *values, double tolerance, Refusal *refusal) {
    Device device = device_of(values);
    Inputs inputs = inputs_of(values);
    device.tolerance = tolerance;
    return system_prepare(system, &device, &inputs, refusal);
}

void decays(const double *x, int count, double *found) {
    for (int i = 0; i < count; i++) {
        found[i] = fast_decay(x[i]);
    }
}

/* Nodes and weights of [-1, 1], and the integrals from 0 to each node of the unit interval, and to 1. */
void gauss(double *node, double *weight, double *integral) {
    static GaussIntegrals gauss;
    gauss_integrals_prepare(&gauss);
    for (int j = 0; j < GAUSS_NODES; j++) {
        node[j] = GAUSS_NODE[j];
        weight[j] = GAUSS_WEIGHT[j];
        for (int i = 0; i <= GAUSS_NODES; i++) {
            integral[GAUSS_NODES * i + j] = gauss.integral[i][j];
        }
    }
}

/* Differences of the velocity [m/s] and the travel [m] of the panel and of series of tolerance 1e-14, `t` [s] after
 * `now`; within the panel of the travel alone. */
static bool compare(const System *series, const BendingPanel *panel, const Moment *now, double t,
                    double *velocity, double *travelled) {
    Moment after;
    Refusal refusal;
    double travel = bending_panel_passage(panel, t).travel;
    Budget budget = budget_of(t);
    if (!events_advance(series, now, t, NULL, NULL, &budget, &after, &refusal)) {
        return false;
    }
    *travelled = fabs(travel - (after.position - now->position));
    *velocity = 0.0;
    if (t >= panel->length) {
        Place ended = bending_panel_place(panel, t);
        *velocity = fabs(ended.state.velocity - after.state.velocity);
        *travelled += fabs(travel - ended.passed.travel);
    }
    return true;
}

/* The panel after the first reversal past `start` [s], held to `tolerance` [m/s]: errors of velocity [m/s]
 * and travel [m] at its end, of the velocity once a fifth more has passed, and of the travel at a `share` of
 * it. Returns whether there is one. */
int panel_errors(const double *values, double start, double tolerance, double share,
                 double *errors) {
    static BendingTables tables;
    static BendingPanel panel;
    System system;
    Moment now, later, reversal;
    Refusal refusal;
    if (!system_of(&system, values, 1e-14, &refusal)) {
        return 0;
    }
    const Plant *plant = &system.plant;
    now = resolved_start(&system);
    EventSearch search = {.after = 0.0};
    Budget budget = budget_of(start);
    if (!events_advance(&system, &now, start, NULL, NULL, &budget, &later, &refusal) ||
        !events_advance(&system, &later, TAU / plant->drive_frequency, &search, NULL, &budget, &reversal,
                     &refusal) ||
        !search.found || reversal.mode == LIFTED || reversal.state.velocity != 0.0) {
        return 0;
    }
    double switching = time_to_switch(plant, reversal.psi, false), unused;
    System by_panels = system;
    by_panels.bending = &tables;
    Phasors phasors = phasors_of(plant, &reversal);
    for (int direction = BACKWARD; direction <= FORWARD; direction += 2) {
        if (bending_panel_begin(&panel, &by_panels, direction, &reversal, &phasors, INFINITY,
                                tolerance) != BY_PANEL ||
            panel.reach < INFINITY || !(1.2 * panel.length < switching)) {
            continue;
        }
        return compare(&system, &panel, &reversal, panel.length, &errors[0], &errors[1]) &&
               compare(&system, &panel, &reversal, 1.2 * panel.length, &errors[2], &unused) &&
               compare(&system, &panel, &reversal, share * panel.length, &unused, &errors[3]);
    }
    return 0;
}
