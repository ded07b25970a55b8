/* Sliding, flight or rest in closed form, for most devices. At rest the plant is that of a held slider.
 *
 * Velocity is v(t) = k0 + k1 t + k2 t^2 + Re(ve exp(i w t) + vq exp(i q t)) - r u(t): the particular solutions at drive
 * and normal frequency are split off from the free motion of the resonator, whose rate is u. That loses digits near
 * resonance, for soft resonators and under slow normal loads; `split_prepare` returns false there, and series are used
 * (taylor_slide.h).
 *
 * Full friction does the work s (F0 (X - X_0) + F1 Im K), with K the integral of n v, n = exp(i chi). Partial
 * integration gives K from both ends. Free motion u = y' adds r T n (stiffness y + i q u) to it, with the response T of
 * the resonator to exp(-i q t). */
#pragma once

#include "../base/first_zero.h"
#include "moment.h"

/* Complex amplitudes per unit exp(i theta) and, for s = 1, per unit exp(i chi): displacement of the resonator
 * (`resonator_*`), velocity of the slider (`velocity_*`); `recoil` is r T. Where `merges`, drive and normal load swing
 * at one frequency, or the normal load is constant: one term of v(t) then stands for both.
 *
 * The drive makes phasors of two frequencies in n v, q + w and q - w (`frequency` [rad/s]). Integration by their ends
 * has a factor of imaginary part `integral`, 0 where they stand still. */
typedef struct {
    bool merges;
    double fastest;
    Complex resonator_drive, velocity_drive, resonator_normal, velocity_normal, recoil;
    double frequency[2], integral[2];
} Split;

/* Compute the amplitudes. Returns false, with `split` undefined, where splitting would lose digits. */
bool split_prepare(Split *split, const Plant *plant);

/* `drive` is exp(i theta). `normal` is exp(i chi) or, if the normal load has the frequency of the drive, the constant
 * exp(i (chi - theta)). */
typedef struct {
    Complex drive, normal;
} Phasors;

/* Phasors at the end of a slide, for the next segment of the same step, if the slide has computed them. They are no
 * part of the state: each step computes them anew. */
typedef struct {
    bool known;
    Phasors phasors;
} KnownPhasors;

Phasors phasors_of(const Plant *plant, const Moment *now);

/* exp(i chi) of the normal load. */
Complex normal_phasor(const Plant *plant, const Phasors *phasors);

/* Force [N] on the slider without friction. */
double force_by(const Plant *plant, const State *state, const Phasors *phasors);

/* Friction force [N] of all faces when sliding steadily; 0 in flight. */
double friction_limit_by(const Plant *plant, const Phasors *phasors);

/* Phasors after `t` [s], with the free motion of the resonator: exp(lambda t), 1 where the resonator is not resolved,
 * or its free response C + i S where it does not oscillate. */
typedef struct {
    double t;
    Phasors phasors;
    Complex free;
} Turns;

/* Motion with friction s (F0 + F1 sin(chi)), s = 1, -1, or 0 in flight, from `theta` and `chi` [rad] on. The resonator
 * vibrates about `constant` [m] + `slope` [m/s] t; its free motion begins at `free_start`. `bound` [m/s^3] bounds the
 * second derivative of the forced part of the velocity. `noise` [m/s] is the rounding error of the velocity.
 *
 * The velocity is watched in `direction`; `sign` is that of friction, 0 in flight. Set after the beginning, `works`
 * says whether the work of friction is wanted.
 *
 * Turns at the latest time for which sines were computed are kept in `anchor`, if `anchored`. Close to the anchor or
 * the `start` these are rotated instead of computing sines. */
typedef struct {
    const Split *split;
    const Plant *plant;
    int direction, sign;
    bool works;
    double theta, chi;
    double constant, slope, k0, k1, k2;
    Complex resonator_drive, resonator_normal, velocity_drive, velocity_normal;
    Response free_start;
    double bound, noise;
    Turns start, anchor;
    bool anchored;
} SplitSlide;

/* Begin at `now`, whose phasors are `start`: a slide in `direction`, or a flight in contact mode LIFTED. The velocity
 * is watched in `direction`, unless that is 0. */
void split_slide_begin(SplitSlide *slide, const Split *split, const Plant *plant, const Moment *now,
                       const Phasors *start, int direction);

/* Adds to the motion a constant velocity `momentum` [m/s] and a free oscillation from the start on, of complex
 * amplitude `swing` [m] of the resonator, with its reaction on the slider. */
void split_slide_change(SplitSlide *slide, double momentum, Complex swing);

/* Makes the known turns after `t` [s] the anchor: exp(i w t) of the drive, exp(i q t) of the normal load and exp(lambda
 * t). */
void split_slide_anchor(SplitSlide *slide, double t, Complex drive, Complex normal, Complex free);

/* The velocity in the direction to watch. */
Watch split_slide_watch(SplitSlide *slide);

/* Time [s] up to which a slide goes on that begins at rest, and whose acceleration is 0 or in its direction; 0 if its
 * third derivative gives no guarantee.
 *
 * Its velocity grows with the second power of time, v >= v'' t^2 / 2 - B t^3 / 6 where B bounds v'''. */
double split_slide_departure(const SplitSlide *slide);

/* At rest, the margins by which the force on the slider is below friction, forwards and backwards, for up to `longest`
 * [s]. Return their number: 0 where no force comes near. */
int split_slide_margins(SplitSlide *slide, double longest, Watch watches[2]);

/* Where a motion is after a time: its state, the passage until then, and the phasors if they are known. */
typedef struct {
    State state;
    Passage passed;
    KnownPhasors known;
} Place;

Place split_slide_place(const SplitSlide *slide, double t);
