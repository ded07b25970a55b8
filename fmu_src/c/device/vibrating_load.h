/* The normal load as a function of the drive angle, for averages over a turn of it. */
#pragma once

#include <stdbool.h>

#include "device.h"

/* Largest number of turns of the drive after which a clipped load may repeat for its phase to count. The more turns,
 * the weaker are the harmonics of the clipping that meet the drive; beyond, the mean counts. */
enum { MAX_TURNS_TO_REPEAT = 4 };

/* Distance of a ratio from a fraction up to which it is due to rounding. */
#define EXACT 1e-12

/* Smallest number of turns q of the drive after which a load repeats; 0 above `max_turns`. Then q `ratio` is an
 * integer, but for rounding or a distance of at most `near` / q. */
int turns_to_repeat(double ratio, int max_turns, double near);

/* Largest number of turns after which the phase of a load counts in averages. Without flight the load is a sine: over
 * several turns it would average out. */
int max_turns_to_repeat(const Device *device);

/* N(n tau + delta) with lift-off, in N, averaged over the `turns` of the drive after which it repeats; where it never
 * does its mean instead (`is_constant`). The contact is in touch from -`dip` to pi + `dip` of the phase of N, and
 * `per_turn` is the integral of N over that; `sine` is sin(delta). */
typedef struct {
    double preload, amplitude, ratio, delta, sine;
    double dip, cos_dip, per_turn;
    int turns;
    bool is_constant;
    double constant;
} VibratingLoad;

VibratingLoad vibrating_load_of(const Device *device, double ratio, double delta);

/* The same load with its mean alone, for ratios other than 0. */
VibratingLoad vibrating_load_flattened(const VibratingLoad *load);

/* The same load, its phase `angle` [rad] further. */
VibratingLoad vibrating_load_turned(const VibratingLoad *load, double angle);

/* Whether the contact lifts. */
static inline bool vibrating_load_lifts(const VibratingLoad *load) {
    return load->amplitude > load->preload;
}

/* Waves of the load over a turn of the drive; 0 for a constant load. */
static inline double vibrating_load_waves(const VibratingLoad *load) {
    return load->is_constant ? 0.0 : load->ratio;
}

/* First drive angle above `angle` [rad] at which the contact lifts or touches down; infinite if it never does. */
double vibrating_load_next_kink(const VibratingLoad *load, double angle);

/* Normal load [N] at drive angle `angle` [rad]. */
double vibrating_load_at(const VibratingLoad *load, double angle);

/* The integral over [turning, 2 pi - turning], where sliding goes forward, less that over [-turning, turning] [N
 * rad]. */
double vibrating_load_difference(const VibratingLoad *load, double turning);
