#include "linear_system.h"

#include <math.h>

/* Smallest pivot that counts as different from 0, relative to the largest entry of the matrix. */
#define SMALLEST_PIVOT 1e-13

bool solve_linear(double matrix[UNKNOWNS][UNKNOWNS], double right[UNKNOWNS], int count) {
    double rows[UNKNOWNS][UNKNOWNS + 1], largest = 0.0; /* the right side is the last column */
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            rows[i][j] = matrix[i][j];
            largest = fmax(largest, fabs(rows[i][j]));
        }
        rows[i][count] = right[i];
    }
    for (int k = 0; k < count; k++) {
        int pivot = k;
        for (int i = k + 1; i < count; i++) {
            pivot = fabs(rows[i][k]) > fabs(rows[pivot][k]) ? i : pivot;
        }
        if (!(fabs(rows[pivot][k]) > SMALLEST_PIVOT * largest)) {
            return false;
        }
        for (int j = k; j <= count; j++) {
            double kept = rows[k][j];
            rows[k][j] = rows[pivot][j];
            rows[pivot][j] = kept;
        }
        for (int i = 0; i < count; i++) {
            double share = i == k ? 0.0 : rows[i][k] / rows[k][k];
            for (int j = k + 1; j <= count; j++) {
                rows[i][j] -= share * rows[k][j];
            }
        }
    }
    for (int k = 0; k < count; k++) {
        right[k] = rows[k][count] / rows[k][k];
    }
    return true;
}
