#include "motions.h"

#include "../resolved/resolved_motion.h"
#include "../averaged/slow_motion.h"
#include "../leap/leaping_motion.h"

const Motion *motion_of(Device *device) {
    if (device->fidelity != 0) {
        return &RESOLVED_MOTION;
    }
    if (device->averaging_order == 1) {
        return &AVERAGED_MOTION;
    }
    device->fidelity = 2; /* leaps are over periods of the full device */
    return &LEAPING_MOTION;
}
