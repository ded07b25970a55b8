#include "orbit_linearisation.h"

#include "elementary.h"
#include <stddef.h>
#include <string.h>

/* Decay in a period below which its series serves. */
#define SMALL_DECAY 1e-3

/* Decay in a period from which on motion is stopped, and not slow: where the slow multiplier goes through 0
 * its logarithm makes much of rounding, and describes motion no better than none. */
#define MAX_DECAY 0.5

/* Iterations of the slow multiplier, each of which leaves the share of the coupling that is left: those that show
 * whether it is separate, and the most; and squarings of a matrix that leave its spectral radius to 1e-7. */
enum { SEPARATING_ITERATIONS = 6, MULTIPLIER_ITERATIONS = 100, SQUARINGS = 24 };

/* Change of its decay, as a share, in the last of those that show it, from which on there is no slow multiplier: it
 * is one of a pair with that of the vibration. And that from which on it is found. */
#define SEPARATED 0.01
#define CONVERGED 1e-12

/* The left eigenvector of the slow multiplier, its first entry 1, and 1 - rho in `decay`, with the
 * `change` of that in the iteration that shows whether it is separate. */
static bool slow_eigenvector(double jacobian[UNKNOWNS][UNKNOWNS], int states,
                             double left[UNKNOWNS], double *decay, double *change) {
    bool converged = false;
    left[0] = 1.0;
    *decay = 0.0;
    for (int i = 1; i <= MULTIPLIER_ITERATIONS && (!converged || i <= SEPARATING_ITERATIONS); i++) {
        double before = *decay;
        double fast[UNKNOWNS][UNKNOWNS] = {{0.0}};
        double right[UNKNOWNS] = {0.0};
        for (int j = 1; j < states; j++) {
            for (int k = 1; k < states; k++) {
                fast[j - 1][k - 1] = jacobian[k][j] + (j == k ? *decay : 0.0);
            }
            right[j - 1] = -jacobian[0][j];
        }
        if (!solve_linear(fast, right, states - 1)) {
            return false;
        }
        *decay = -jacobian[0][0];
        for (int j = 1; j < states; j++) {
            left[j] = right[j - 1];
            *decay -= left[j] * jacobian[j][0];
        }
        converged = fabs(*decay - before) <= CONVERGED * fabs(*decay);
        *change = i == SEPARATING_ITERATIONS ? *decay - before : *change;
    }
    return isfinite(*decay);
}

static double spectral_radius(double matrix[UNKNOWNS][UNKNOWNS], int count) {
    double logarithm = 0.0, weight = 1.0;
    for (int squaring = 0; squaring < SQUARINGS; squaring++) {
        double largest = 0.0, square[UNKNOWNS][UNKNOWNS] = {{0.0}};
        for (int i = 0; i < count; i++) {
            for (int j = 0; j < count; j++) {
                largest = fmax(largest, fabs(matrix[i][j]));
            }
        }
        if (!(largest > 0.0)) {
            return 0.0;
        }
        for (int i = 0; i < count; i++) {
            for (int j = 0; j < count; j++) {
                for (int k = 0; k < count; k++) {
                    square[i][j] += matrix[i][k] / largest * (matrix[k][j] / largest);
                }
            }
        }
        logarithm += weight * log(largest);
        weight *= 0.5;
        memcpy(matrix, square, sizeof square);
    }
    return exp(logarithm);
}

double largest_multiplier(double jacobian[UNKNOWNS][UNKNOWNS], int states) {
    double matrix[UNKNOWNS][UNKNOWNS];
    memcpy(matrix, jacobian, sizeof matrix);
    for (int i = 0; i < states; i++) {
        matrix[i][i] += 1.0;
    }
    return spectral_radius(matrix, states);
}

/* The largest multiplier on the states in which the slow motion has no part. */
static double fast_multiplier(double jacobian[UNKNOWNS][UNKNOWNS], int states,
                              const double left[UNKNOWNS]) {
    double fast[UNKNOWNS][UNKNOWNS] = {{0.0}};
    for (int i = 1; i < states; i++) {
        for (int j = 1; j < states; j++) {
            fast[i - 1][j - 1] =
                jacobian[i][j] + (i == j ? 1.0 : 0.0) - jacobian[i][0] * left[j];
        }
    }
    return spectral_radius(fast, states - 1);
}

/* By how much the mean of an exponential decay over a period is above its start, over its change: 1
 * / ln(1 - d) + 1 / d. */
static double mean_share(double decay) {
    return fabs(decay) < SMALL_DECAY ? 0.5 + decay / 12.0 : 1.0 / log1p(-decay) + 1.0 / decay;
}

/* The lag xi behind the orbit. */
static bool find_lag(double jacobian[UNKNOWNS][UNKNOWNS], int states, OrbitLinearisation *result) {
    double matrix[UNKNOWNS][UNKNOWNS] = {{0.0}}, right[UNKNOWNS] = {0.0};
    double decay = 1.0 - result->multiplier;
    for (int i = 0; i <= states; i++) {
        for (int j = 0; j < states; j++) {
            matrix[i][j] = jacobian[i][j] + (i == j ? decay : 0.0);
        }
        matrix[i][states] = i < states ? -result->tangent[i] : -mean_share(decay);
        right[i] = -jacobian[i][states];
    }
    if (!solve_linear(matrix, right, states + 1)) {
        return false;
    }
    memcpy(result->lag, right, (size_t)states * sizeof right[0]);
    return true;
}

bool linearise_orbit(double jacobian[UNKNOWNS][UNKNOWNS], int states, OrbitLinearisation *result) {
    double left[UNKNOWNS], decay, change = 0.0, tangent[UNKNOWNS] = {0.0};
    tangent[states] = 1.0;
    if (!solve_linear(jacobian, tangent, states + 1) ||
        !slow_eigenvector(jacobian, states, left, &decay, &change)) {
        return false;
    }
    double gained = 0.0, moved = 0.0;
    for (int i = 0; i < states; i++) {
        gained -= left[i] * jacobian[i][states];
        moved += left[i] * tangent[i];
    }
    *result = (OrbitLinearisation){.slope = -tangent[states], .multiplier = 1.0 - decay};
    memcpy(result->tangent, tangent, (size_t)states * sizeof tangent[0]);
    result->fast_multiplier = fast_multiplier(jacobian, states, left);
    result->is_slow = decay < MAX_DECAY;
    result->is_separate = fabs(change) <= SEPARATED * fabs(decay) + SMALL_DECAY &&
                          result->fast_multiplier < fabs(1.0 - decay);
    double stretch = result->is_slow && decay != 0.0 ? -log1p(-decay) / decay : 1.0;
    result->factor = result->is_slow ? gained / moved * stretch : 1.0;
    return !result->is_slow || find_lag(jacobian, states, result);
}
