#include "motion.h"

const Motion *motion_of(const Device *device) {
    if (device->fidelity != 0) {
        return &RESOLVED_MOTION;
    }
    return device->averaging_order == 1 ? &AVERAGED_MOTION : &LEAPING_MOTION;
}
