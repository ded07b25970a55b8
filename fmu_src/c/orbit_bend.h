/* The bend of a bristle that friction slows down, by which motion differs from an orbit until it has decayed.
 *
 * By itself a bend decays over the path of the slider. Where that is hardly faster than the slow motion, the two
 * share their decay: the bend's is that of the fast multiplier of an orbit. */
#ifndef SLIDER_ORBIT_BEND_H
#define SLIDER_ORBIT_BEND_H

#include "law.h"

/* Decay of the bend in a turn, on the orbits at `lead` [rad] next to a moment; infinite where it is fast by itself,
 * and where there is no orbit. */
double orbit_bend_decay(const Law *law, double lead, const Moment *moment);

/* What a bend of this decay changes the slow velocity by [m/s] after a drive angle [rad] in which it decayed. */
double velocity_of_bend(const Law *law, double decay, double angle);

#endif
