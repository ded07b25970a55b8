/* The resonator's own swing, by which motion differs from an orbit until it has decayed. */
#ifndef SLIDER_ORBIT_SWING_H
#define SLIDER_ORBIT_SWING_H

#include "law.h"

/* The swing `t` [s] later: it moves the pair, but not its momentum. */
Response swing_after(const Law *law, const Response *swing, double t);

/* Add the swing to a moment on an orbit. A slider that sticks stays at rest. */
void add_swing(Moment *moment, const Response *swing, double share);

#endif
