#include "elementary_functions.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Constants in two parts; the first has so few bits that its products with counts are exact. */
#define QUARTER 1.5707963267341256
#define QUARTER_REST 6.077100506506192e-11
#define OCTAVE 0.6931471804855391
#define OCTAVE_REST 7.440617110012397e-11

#define QUARTERS_PER_RADIAN 0.63661977236758134
#define OCTAVES_PER_UNIT 1.4426950408889634
#define PI 3.141592653589793
#define HALF_PI 1.5707963267948966
#define HALF_PI_REST 6.123233995736766e-17

/* Largest angle [rad] whose quarter turns are counted. */
#define MAX_ANGLE 1e6

/* Largest exponent of a normal number both ways. */
#define MAX_EXPONENT 708.0

/* Range in which squares are normal numbers. */
#define SMALL_SQUARE 1e-280
#define LARGE_SQUARE 1e280

/* A sum with it rounds to an integer, which then are the last bits. */
#define SHIFT 0x1.8p52

/* Polynomials are Taylor series of twice the order, economised by Chebyshev polynomials: to 1e-17. Processors compute
 * pairs of their terms in parallel. */

/* An argument within the range of a polynomial, and what its rounding has left out. */
typedef struct {
    double value, tail;
} Rest;

/* `first` less `second`. */
static inline Rest difference(double first, double second) {
    double value = first - second;
    return (Rest){value, (first - value) - second};
}

static inline double sine_within(Rest rest) {
    double r = rest.value, z = r * r, y = z * z;
    double sum = -2.505112999912784e-08 + z * 1.5917995630635248e-10;
    sum = (-0.00019841269836741755 + z * 2.755731609375319e-06) + y * sum;
    sum = (-0.16666666666666666 + z * 0.008333333333330938) + y * sum;
    return r + (r * (z * sum) + rest.tail);
}

static inline double cosine_within(Rest rest) {
    double r = rest.value, z = r * r, y = z * z, half = 0.5 * z, most = 1.0 - half;
    double sum = 2.0876145106497293e-09 - z * 1.1382548343152154e-11;
    sum = (2.480158729875508e-05 - z * 2.7557317266186513e-07) + y * sum;
    sum = (0.041666666666666664 - z * 0.001388888888888739) + y * sum;
    return most + (((1.0 - most) - half) + (z * z * sum - r * rest.tail));
}

/* exp(r) - 1 for |r| <= ln(2) / 2. */
static inline double growth_within(Rest rest) {
    double r = rest.value, z = r * r;
    double sum = 2.7620086491464514e-07 + r * 2.5105215165649368e-08;
    sum = (2.4801521299750923e-05 + r * 2.75572554044176e-06) + z * sum;
    sum = (0.001388888891721154 + r * 0.00019841269874817515) + z * sum;
    sum = (0.04166666666662413 + r * 0.008333333333326136) + z * sum;
    sum = (0.5000000000000001 + r * 0.1666666666666667) + z * sum;
    return r + (z * sum + rest.tail);
}

/* asin(x) for |x| <= 1/2. */
static double asin_within(double x) {
    double z = x * x;
    double sum = -0.015032162599250309 + z * 0.02887836274645239;
    sum = 0.00541318448371551 + z * (0.017518833979538666 + z * sum);
    sum = 0.011477517005507167 + z * (0.01033337215296726 + z * sum);
    sum = 0.017352380709839098 + z * (0.01397138708310213 + z * sum);
    sum = 0.03038194412500875 + z * (0.022372173467043486 + z * sum);
    sum = 0.0749999999999834 + z * (0.04464285714653523 + z * sum);
    sum = 0.16666666666666669 + z * sum;
    return x + x * (z * sum);
}

static inline uint64_t bits_of(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static inline double number_of(uint64_t bits) {
    double x;
    memcpy(&x, &bits, sizeof x);
    return x;
}

/* An angle less its quarter turns, and their count in the last two bits. */
typedef struct {
    Rest rest;
    unsigned count;
} Quarters;

static inline Quarters quarters_of(double x) {
    double shifted = x * QUARTERS_PER_RADIAN + SHIFT, count = shifted - SHIFT;
    return (Quarters){difference(x - count * QUARTER, count * QUARTER_REST), (unsigned)bits_of(shifted)};
}

SineCosine elementary_sine_cosine(double x) {
    if (!(fabs(x) < MAX_ANGLE)) {
        return (SineCosine){sin(x), cos(x)};
    }
    Quarters quarters = quarters_of(x);
    double sine = sine_within(quarters.rest), cosine = cosine_within(quarters.rest);
    double first = quarters.count & 1 ? cosine : sine, second = quarters.count & 1 ? sine : cosine;
    return (SineCosine){quarters.count & 2 ? -first : first, (quarters.count + 1) & 2 ? -second : second};
}

double elementary_sin(double x) {
    return elementary_sine_cosine(x).sine;
}

double elementary_cos(double x) {
    return elementary_sine_cosine(x).cosine;
}

double elementary_hypot(double x, double y) {
    double square = x * x + y * y;
    return square > SMALL_SQUARE && square < LARGE_SQUARE ? sqrt(square) : hypot(x, y);
}

double elementary_atan2(double y, double x) {
    double square = x * x + y * y;
    if (!(square > SMALL_SQUARE && square < LARGE_SQUARE)) {
        return atan2(y, x);
    }
    double least = fmin(fabs(x), fabs(y)) / sqrt(square), across = asin_within(least);
    if (least > 0.5) {
        across = HALF_PI - (2.0 * asin_within(sqrt(0.5 * (1.0 - least))) - HALF_PI_REST);
    }
    if (fabs(y) > fabs(x)) {
        across = HALF_PI - (across - HALF_PI_REST);
    }
    return copysign(x < 0.0 ? PI - (across - 2.0 * HALF_PI_REST) : across, y);
}

double elementary_asin(double x) {
    return elementary_atan2(x, sqrt((1.0 - x) * (1.0 + x)));
}

double elementary_acos(double x) {
    return elementary_atan2(sqrt((1.0 - x) * (1.0 + x)), x);
}

/* x less its octaves, and 2^n for n of them. */
typedef struct {
    Rest rest;
    double power;
} Octaves;

static inline Octaves octaves_of(double x) {
    double shifted = x * OCTAVES_PER_UNIT + SHIFT, count = shifted - SHIFT;
    return (Octaves){difference(x - count * OCTAVE, count * OCTAVE_REST), number_of((bits_of(shifted) + 1023) << 52)};
}

double elementary_exp(double x) {
    if (!(fabs(x) < MAX_EXPONENT)) {
        return exp(x);
    }
    Octaves octaves = octaves_of(x);
    return octaves.power + octaves.power * growth_within(octaves.rest);
}

double elementary_expm1(double x) {
    if (!(fabs(x) < MAX_EXPONENT)) {
        return expm1(x);
    }
    Octaves octaves = octaves_of(x);
    return (octaves.power - 1.0) + octaves.power * growth_within(octaves.rest);
}

/* By 2 artanh(s), s = (m - 1) / (m + 1), for x = m 2^n with m between the roots of 1/2 and 2. */
double elementary_log(double x) {
    if (!(x >= 1e-300 && x <= 1e300)) {
        return log(x);
    }
    const uint64_t root = bits_of(0.70710678118654752);
    uint64_t above = bits_of(x) - root;
    double count = (double)((int64_t)above >> 52);
    double m = number_of((above & UINT64_C(0x000fffffffffffff)) + root);
    double s = (m - 1.0) / (m + 1.0), z = s * s, sum = 2.0 / 23.0;
    sum = 2.0 / 19.0 + z * (2.0 / 21.0 + z * sum);
    sum = 2.0 / 15.0 + z * (2.0 / 17.0 + z * sum);
    sum = 2.0 / 11.0 + z * (2.0 / 13.0 + z * sum);
    sum = 2.0 / 7.0 + z * (2.0 / 9.0 + z * sum);
    sum = 2.0 / 3.0 + z * (2.0 / 5.0 + z * sum);
    return count * OCTAVE + (count * OCTAVE_REST + (2.0 * s + s * (z * sum)));
}
