/* Sliding or flight as a sum of exponentials: the fast form, for most devices.
 *
 * Velocity is v(t) = k0 + k1 t + k2 t^2 + Re(ve exp(i w t) + vq exp(i q t) + vh exp(lambda t)): the
 * particular solutions at drive and normal frequency are split off from the free oscillation. That
 * loses digits near resonance and for slow normal loads; `split_prepare` answers false there and
 * RegularSlide serves. */
#ifndef SLIDER_SPLIT_SLIDE_H
#define SLIDER_SPLIT_SLIDE_H

#include <stdbool.h>

#include "first_zero.h"
#include "plant.h"
#include "state.h"

/* Complex amplitudes per unit exp(i theta) and, for s = 1, per unit exp(i chi): displacement of the
 * resonator (`resonator_*`), velocity of the slider (`velocity_*`). Where `merges`, drive and normal
 * load swing at one frequency, or the normal load is constant: one term of v(t) then stands for
 * both. */
typedef struct {
    bool merges;
    double fastest;
    Complex resonator_drive, velocity_drive, resonator_normal, velocity_normal;
} Split;

/* The amplitudes; false where splitting would lose digits. */
bool split_prepare(Split *split, const Plant *plant);

/* exp(i theta) of the drive, and of the normal load exp(i chi), or what does not change during motion:
 * exp(i (chi - theta)) at the frequency of the drive. */
typedef struct {
    Complex drive, normal;
} Phasors;

/* Phasors of the present angles, kept where a slide knows them at its end from sines and cosines that
 * were computed in it. They are no part of the state: a step computes them anew. */
typedef struct {
    bool known;
    Phasors phasors;
} KnownPhasors;

Phasors phasors_of(const Plant *plant, double theta, double chi);

/* Friction force [N] of all faces when sliding steadily; 0 in flight. */
double friction_limit_by(const Plant *plant, const Phasors *phasors);

/* Phasors after `t` [s], with exp(lambda t) (`free`) and its absolute value (`envelope`); these are 1
 * where no resonator swings freely. */
typedef struct {
    double t;
    Phasors phasors;
    Complex free;
    double envelope;
} Turns;

/* Motion with friction s (F0 + F1 sin(chi)), s = 1, -1, or 0 in flight, from `theta` and `chi` [rad]
 * on. The resonator follows `constant` [m] + `slope` [m/s] t and swings about it. `travel_free` is the integral of the free part of the velocity, vh / lambda [m]; `bound` and
 * `free_bound` [m/s^3] bound the second derivative of the velocity: of its forced part, and of its
 * free part at first. `noise` [m/s] is the rounding error of the velocity.
 *
 * `anchor` is the latest time for which sines and cosines were computed, where `anchored`: close to
 * it, or to the `start`, known turns are rotated by a little. */
typedef struct {
    const Split *split;
    const Plant *plant;
    int direction;
    double theta, chi;
    double constant, slope, k0, k1, k2;
    Complex resonator_drive, resonator_normal, resonator_free;
    Complex velocity_drive, velocity_normal, velocity_free;
    Complex travel_free;
    double bound, free_bound, noise;
    Turns start, anchor;
    bool anchored;
} SplitSlide;

/* The velocity is watched in `direction`, unless that is 0. `start` are the phasors of `theta` and
 * `chi`. */
void split_slide_begin(SplitSlide *slide, const Split *split, const Plant *plant, int sign,
                       const State *state, double theta, double chi, const Phasors *start,
                       int direction);

/* The velocity in the direction to watch. */
Watch split_slide_watch(SplitSlide *slide);

/* Displacement of the slider after `t` [s], in m. */
double split_slide_travel(const SplitSlide *slide, double t);

/* State after `t` [s], the displacement [m] in `travel`, and the phasors. */
State split_slide_end(const SplitSlide *slide, double t, double *travel, KnownPhasors *known);

#endif
