/* exp(-x) without a call, in a form that compilers turn into vector instructions. */
#pragma once

#include <stdint.h>
#include <string.h>

/* exp(-x) for x >= 0, with a relative error of 1e-14; exp(-700) for x above 700.
 *
 * With x = n ln 2 - r it is exp(r) / 2^n. Adding 1.5 * 2^52 rounds to the integer n and leaves it in the last bits; ln
 * 2 is split in two so that r is exact to rounding. */
static inline double fast_decay(double x) {
    const double per_octave = 1.4426950408889634, shift = 0x1.8p52;
    const double octave = 0x1.62e42fefap-1, octave_rest = 0x1.cf79abc9e3b3ap-40;
    double bounded = x < 700.0 ? x : 700.0;
    double shifted = bounded * per_octave + shift, octaves = shifted - shift;
    double r = (octaves * octave - bounded) + octaves * octave_rest;
    double grown = 1.0 / 3628800.0 + r * (1.0 / 39916800.0);
    grown = 1.0 / 40320.0 + r * (1.0 / 362880.0 + r * grown);
    grown = 1.0 / 720.0 + r * (1.0 / 5040.0 + r * grown);
    grown = 1.0 / 24.0 + r * (1.0 / 120.0 + r * grown);
    grown = 1.0 + r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * grown)));
    uint64_t bits;
    double scale;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (UINT64_C(1023) - bits) << 52;
    memcpy(&scale, &bits, sizeof scale);
    return grown * scale;
}
