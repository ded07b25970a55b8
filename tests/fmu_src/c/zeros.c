/* The search for the first zero of a sum of sines, for tests: numbers in, numbers out. */
#include <math.h>

#include "base/first_zero.h"

/* offset + sum of a sin(w t + p), the `waves` being (a, w, p); `loose` times the sum of |a| w^2 bounds its
 * curvature. */
typedef struct {
    double offset, loose;
    const double *waves;
    int count, evaluations;
} Sum;

static Signal sum_at(void *motion, double t) {
    Sum *sum = motion;
    Signal at = {sum->offset, 0.0, 0.0};
    for (int i = 0; i < sum->count; i++) {
        const double *wave = &sum->waves[3 * i];
        double turned = wave[1] * t + wave[2];
        at.value += wave[0] * sin(turned);
        at.slope += wave[0] * wave[1] * cos(turned);
        at.bound += sum->loose * fabs(wave[0]) * wave[1] * wave[1];
    }
    sum->evaluations++;
    return at;
}

/* The first downward zero before `limit` [s], near `expected` if that is not negative, or NO_ZERO; `work` is
 * the number of evaluations. */
double first_zero_of_waves(double offset, double loose, const double *waves, int count, double noise,
                           double fastest, double limit, double expected, int *work) {
    Sum sum = {offset, loose, waves, count, 0};
    Watch watch = {sum_at, &sum, noise, fastest, INFINITY};
    double zero = first_zero(&watch, limit, 0.0, expected);
    *work = sum.evaluations;
    return zero;
}
