#include "complex_number.h"

/* |z| up to which integrals are series, and the terms of these: good to rounding. */
#define SMALL 0.5
enum { TERMS = 14 };

Growth growth_of(Complex z) {
    Complex one = complex_of(1.0, 0.0);
    Growth growth;
    if (complex_abs(z) > SMALL) {
        growth.grown = complex_rect(elementary_exp(z.re), z.im);
        growth.once = complex_div(complex_sub(growth.grown, one), z);
        growth.twice = complex_div(complex_sub(growth.once, one), z);
        return growth;
    }
    Complex sum = complex_of(0.0, 0.0);
    for (int n = TERMS; n >= 2; n--) {
        sum = complex_scale(1.0 / n, complex_add(one, complex_mul(z, sum)));
    }
    growth.twice = sum;
    growth.once = complex_add(one, complex_mul(z, growth.twice));
    growth.grown = complex_add(one, complex_mul(z, growth.once));
    return growth;
}
