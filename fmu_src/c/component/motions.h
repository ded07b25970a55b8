/* The choice of the kind of motion. */
#ifndef SLIDER_MOTIONS_H
#define SLIDER_MOTIONS_H

#include "../resolved/motion.h"

/* The motion of a device, by its fidelity and averaging order; `device` becomes the one that this motion moves. */
const Motion *motion_of(Device *device);

#endif
