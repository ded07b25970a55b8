#include "gauss_nodes.h"

#include <math.h>

const double GAUSS_NODE[GAUSS_NODES] = {
    -0.9894009349916499, -0.9445750230732326,  -0.8656312023878318, -0.755404408355003,
    -0.6178762444026438, -0.45801677765722737, -0.2816035507792589, -0.09501250983763744,
    0.09501250983763744, 0.2816035507792589,   0.45801677765722737, 0.6178762444026438,
    0.755404408355003,   0.8656312023878318,   0.9445750230732326,  0.9894009349916499,
};
const double GAUSS_WEIGHT[GAUSS_NODES] = {
    0.027152459411754096, 0.062253523938647894, 0.09515851168249279,  0.12462897125553388,
    0.14959598881657674,  0.16915651939500254,  0.18260341504492358,  0.1894506104550685,
    0.1894506104550685,   0.18260341504492358,  0.16915651939500254,  0.14959598881657674,
    0.12462897125553388,  0.09515851168249279,  0.062253523938647894, 0.027152459411754096,
};

void legendre(double x, double values[GAUSS_NODES + 1]) {
    values[0] = 1.0;
    values[1] = x;
    for (int k = 1; k < GAUSS_NODES; k++) {
        values[k + 1] = ((2 * k + 1) * x * values[k] - k * values[k - 1]) / (k + 1);
    }
}

/* Integrals from 0 to `end` <= 1. */
static void integrate(const GaussIntegrals *gauss, double end, double integral[GAUSS_NODES]) {
    double values[GAUSS_NODES + 1];
    legendre(2.0 * end - 1.0, values);
    for (int j = 0; j < GAUSS_NODES; j++) {
        integral[j] = gauss->weighed[0][j] * end;
        for (int k = 1; k < GAUSS_NODES; k++) {
            integral[j] += gauss->weighed[k][j] * (0.5 * (values[k + 1] - values[k - 1]));
        }
    }
}

void gauss_integrals_prepare(GaussIntegrals *gauss) {
    for (int j = 0; j < GAUSS_NODES; j++) {
        double values[GAUSS_NODES + 1];
        legendre(GAUSS_NODE[j], values);
        for (int k = 0; k < GAUSS_NODES; k++) {
            gauss->weighed[k][j] = 0.5 * GAUSS_WEIGHT[j] * values[k];
        }
    }
    for (int i = 0; i < GAUSS_NODES; i++) {
        integrate(gauss, 0.5 * (GAUSS_NODE[i] + 1.0), gauss->integral[i]);
        gauss->integral[GAUSS_NODES][i] = 0.5 * GAUSS_WEIGHT[i];
    }
}

double gauss_integral(const GaussIntegrals *gauss, double end, const double *values) {
    double integral[GAUSS_NODES], sum = 0.0;
    integrate(gauss, end, integral);
    for (int j = 0; j < GAUSS_NODES; j++) {
        sum += integral[j] * values[j];
    }
    return sum;
}

/* Legendre coefficient `k` of the polynomial through `values`. */
static double coefficient(const GaussIntegrals *gauss, const double *values, int k) {
    double sum = 0.0;
    for (int j = 0; j < GAUSS_NODES; j++) {
        sum += (2 * k + 1) * gauss->weighed[k][j] * values[j];
    }
    return sum;
}

void gauss_coefficients(const GaussIntegrals *gauss, const double *values, double coefficients[GAUSS_NODES]) {
    for (int k = 0; k < GAUSS_NODES; k++) {
        coefficients[k] = coefficient(gauss, values, k);
    }
}

double gauss_last(const GaussIntegrals *gauss, const double *values) {
    return fmax(fabs(coefficient(gauss, values, GAUSS_NODES - 1)), fabs(coefficient(gauss, values, GAUSS_NODES - 2)));
}
