#include "interpolant.h"

#include <math.h>
#include <string.h>

/* Number of points of which the one in the widest gap is taken. */
enum { CANDIDATES = 24 };

void interpolant_add(Interpolant *polynomials, double x, const double values[FUNCTIONS]) {
    int count = polynomials->count;
    double *row = polynomials->difference[count];
    memcpy(row, values, FUNCTIONS * sizeof row[0]);
    for (int i = 0; i < count; i++) {
        double distance = x - polynomials->point[i];
        for (int k = 0; k < FUNCTIONS; k++) {
            row[k] = (row[k] - polynomials->difference[i][k]) / distance;
        }
    }
    polynomials->point[count] = x;
    polynomials->count++;
}

void interpolant_at(const Interpolant *polynomials, double x, int functions,
                    double values[FUNCTIONS]) {
    for (int k = 0; k < functions; k++) {
        values[k] = 0.0;
    }
    for (int i = polynomials->count - 1; i >= 0; i--) {
        double distance = x - polynomials->point[i];
        for (int k = 0; k < functions; k++) {
            values[k] = polynomials->difference[i][k] + distance * values[k];
        }
    }
}

double interpolant_gap(const Interpolant *polynomials, double from, double to) {
    double widest = -1.0, found = from;
    for (int j = 1; j < CANDIDATES; j++) {
        double x = from + (to - from) * j / CANDIDATES, product = 1.0;
        for (int i = 0; i < polynomials->count; i++) {
            product *= fabs((x - polynomials->point[i]) / (to - from));
        }
        if (product > widest) {
            widest = product;
            found = x;
        }
    }
    return found;
}
