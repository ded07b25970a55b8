/* exp(-x) of many numbers at once, in a form that compilers turn into vector instructions. */
#ifndef SLIDER_DECAY_ROW_H
#define SLIDER_DECAY_ROW_H

#include <stdint.h>
#include <string.h>

/* exp(-x) for x >= 0, to 1e-14 of it; past 700 it is that of 700. */
static inline double decay(double x) {
    const double per_octave = 1.4426950408889634, magic = 0x1.8p52;
    const double octave = 0x1.62e42fefap-1, octave_rest = 0x1.cf79abc9e3b3ap-40;
    double clamped = x < 700.0 ? x : 700.0;
    double shifted = clamped * per_octave + magic, octaves = shifted - magic;
    double r = (octaves * octave - clamped) + octaves * octave_rest;
    double tail = 1.0 / 5040.0 + r * (1.0 / 40320.0 + r * (1.0 / 362880.0 + r * (1.0 / 3628800.0 + r * (1.0 / 39916800.0))));
    double head = 1.0 + r * (1.0 + r * (0.5 + r * (1.0 / 6.0 + r * (1.0 / 24.0 + r * (1.0 / 120.0 + r * (1.0 / 720.0 + r * tail))))));
    uint64_t bits;
    double scale;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (UINT64_C(1023) - bits) << 52;
    memcpy(&scale, &bits, sizeof scale);
    return head * scale;
}

#endif
