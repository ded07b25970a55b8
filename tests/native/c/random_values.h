/* Random numbers of a fixed sequence, and arguments for calls: good, bad and absurd. */
#ifndef NATIVE_RANDOM_VALUES_H
#define NATIVE_RANDOM_VALUES_H

#include <math.h>
#include <stdint.h>
#include <stddef.h>

/* Size of the arrays that the fuzzer passes; a larger count must be refused before an entry is read. */
enum { ROOM = 64 };

static uint64_t random_state = 1;

/* xorshift64* */
static inline uint32_t random_bits(void) {
    random_state ^= random_state >> 12;
    random_state ^= random_state << 25;
    random_state ^= random_state >> 27;
    return (uint32_t)((random_state * UINT64_C(2685821657736338717)) >> 32);
}

static inline uint32_t below(uint32_t limit) {
    return random_bits() % limit;
}

static inline int one_in(uint32_t odds) {
    return below(odds) == 0;
}

static inline double random_share(void) {
    return random_bits() / 4294967296.0;
}

/* Up to 3500 in size, or beyond all bounds: frequencies between these would be accepted, at a cost in
 * proportion to them. */
static inline double random_real(void) {
    static const double special[] = {0.0,    -0.0,   1.0,     -1.0,   0.5,    2.0,   3.0,    3500.0,
                                     -3500.0, 1e-12, -1e-12,  5e-324, 1e-300, 1e300, -1e300, 1.7e308};
    if (one_in(12)) return one_in(3) ? NAN : one_in(2) ? INFINITY : -INFINITY;
    if (one_in(4)) return special[below(sizeof special / sizeof *special)];
    if (one_in(8)) return (random_share() - 0.5) * pow(10.0, 23.0 * random_share() - 20.0);
    return (random_share() - 0.3) * 3.0;
}

/* Seldom above a millisecond, never above 20: the work of a step is in proportion to it. */
static inline double random_step(void) {
    double any = random_real();
    if (one_in(20) && !(any > 0.02 && any <= 1e308)) return any;
    return one_in(50) ? 0.02 * random_share() : 1e-3 * random_share() * random_share();
}

static inline int random_integer(void) {
    static const int special[] = {0, 1, 2, -1, 3, 7, 2147483647, -2147483647 - 1};
    return special[below(one_in(4) ? 8 : 3)];
}

static inline unsigned random_reference(void) {
    static const unsigned wrong[] = {40, 41, 63, 1000, 0x7fffffffu, 0x80000000u, 0xffffffffu};
    return one_in(40) ? wrong[below(7)] : below(40);
}

static inline size_t random_count(void) {
    static const size_t absurd[] = {65, 1000, (size_t)-1, (size_t)-1 / 8 + 1, (size_t)-1 / 4 + 1};
    if (one_in(20)) return absurd[below(5)];
    return one_in(10) ? below(ROOM + 1) : 1 + below(3);
}

/* A function that is called, as often as its weight says. */
typedef struct {
    const char *name;
    unsigned weight;
} Function;

static inline unsigned some_function(const Function *functions, unsigned count) {
    unsigned total = 0, drawn, i;
    for (i = 0; i < count; i++) total += functions[i].weight;
    drawn = below(total);
    for (i = 0; drawn >= functions[i].weight; i++) drawn -= functions[i].weight;
    return i;
}

#endif
