#include "orbit_newton.h"

#include <math.h>

/* Correction of the unknowns, in their scales, below which an orbit is found. Up to ROUNDED it is found
 * also where corrections no longer decrease, by rounding. */
#define COULOMB_CONVERGED 1e-13
#define LUGRE_CONVERGED 1e-12
#define ROUNDED 1e-9

/* Smallest damping factor of a Newton step. */
#define SMALLEST_PART 0.015

Unknowns unknowns_after(const Unknowns *unknowns, const double step[UNKNOWNS], double part) {
    Unknowns next;
    for (int i = 0; i < UNKNOWNS; i++) {
        next.at[i] = unknowns->at[i] + part * step[i];
    }
    return next;
}

/* Broyden's update: the Jacobian that maps the move to the change of the values, and is otherwise
 * unchanged. */
static void update_jacobian(double jacobian[UNKNOWNS][UNKNOWNS], int count, const Unknowns *from,
                            const Unknowns *to, const double before[UNKNOWNS],
                            const double after[UNKNOWNS]) {
    double moved[UNKNOWNS] = {0.0}, square = 0.0;
    for (int j = 0; j < count; j++) {
        moved[j] = to->at[j] - from->at[j];
        square += moved[j] * moved[j];
    }
    for (int i = 0; i < count; i++) {
        double missed = after[i] - before[i];
        for (int j = 0; j < count; j++) {
            missed -= jacobian[i][j] * moved[j];
        }
        for (int j = 0; j < count; j++) {
            jacobian[i][j] += missed * moved[j] / square;
        }
    }
}

/* The largest part of a step that contracts, with the unknowns (`next`) and the trial after it; 0 for none.
 * Parts below 1 are tried only with a fresh Jacobian. `size` is that of the step. */
static double accepted_part(OrbitEquations *equations, double jacobian[UNKNOWNS][UNKNOWNS],
                            const Unknowns *unknowns, const double step[UNKNOWNS], double size,
                            bool fresh, Unknowns *next, Trial *trial) {
    double part = 1.0;
    while (isfinite(size) && part > SMALLEST_PART && equations->maps < MAX_MAPS) {
        double left[UNKNOWNS] = {0.0};
        *next = unknowns_after(unknowns, step, part);
        if (try_unknowns(equations, next, trial) &&
            newton_step(equations, jacobian, trial->values, next, left) / size <=
                1.0 - 0.25 * part) {
            return part;
        }
        if (!fresh || size <= ROUNDED) {
            break;
        }
        part *= 0.25;
    }
    return 0.0;
}

bool solve_orbit(OrbitEquations *equations, Unknowns *unknowns, Trial *trial,
                 double jacobian[UNKNOWNS][UNKNOWNS], bool fresh) {
    int count = equations->map->states + 1;
    double accuracy = equations->map->states > 3 ? LUGRE_CONVERGED : COULOMB_CONVERGED;
    double before = INFINITY;
    while (equations->maps < MAX_MAPS) {
        double step[UNKNOWNS] = {0.0};
        double size = newton_step(equations, jacobian, trial->values, unknowns, step);
        if (size <= accuracy || (size <= ROUNDED && size > 0.5 * before)) {
            *unknowns = unknowns_after(unknowns, step, 1.0);
            for (int j = 0; j < count; j++) {
                trial->values[count - 1] += jacobian[count - 1][j] * step[j];
            }
            return true;
        }
        Unknowns next;
        Trial other;
        double part =
            accepted_part(equations, jacobian, unknowns, step, size, fresh, &next, &other);
        if (part > 0.0) {
            if (part * size > DIFFERENCE) {
                update_jacobian(jacobian, count, unknowns, &next, trial->values, other.values);
            }
            *unknowns = next;
            *trial = other;
            fresh = false;
            before = size;
        } else if (size <= ROUNDED) {
            return true;
        } else if (fresh || !differentiate(equations, unknowns, trial, jacobian)) {
            return false;
        } else {
            fresh = true;
        }
    }
    return false;
}
