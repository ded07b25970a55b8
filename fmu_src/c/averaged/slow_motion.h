/* Averaged motion of first order, fidelity 0: the slow motion of the pair under mean friction.
 *
 * With D the amplitude of the drive force on the pair, its momentum over the total mass is P = X' + r_m Y'
 * = V - D cos(theta) / (w (M + m)), and its centre is X + r_m Y. Both are continuous, also where a parameter
 * is tuned. V is the slow velocity: (M + m) V' = -mean friction - load. The fast parts of all outputs are
 * the steady vibration (32)-(33), added in closed form.
 *
 * The bristle follows the motion periodically; it has no state here. */
#pragma once

#include "../resolved/motion.h"

extern const Motion AVERAGED_MOTION;
