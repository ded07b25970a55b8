/* The bristle of LuGre friction as a function of the path (eq. 8). */
#pragma once

#include <math.h>
#include <stdbool.h>

#include "../base/elementary_functions.h"

/* Coefficient mu [1], stiffness sigma_0 [1/m] and damping sigma_1 [s/m]. Coulomb friction is that of a rigid bristle,
 * whose stiffness is infinite. */
typedef struct {
    double coefficient, stiffness, damping;
} Bristle;

/* Whether the bristle bends: a slider at rest then does not stick, and takes tables to follow. */
static inline bool is_elastic(const Bristle *bristle) {
    return isfinite(bristle->stiffness);
}

/* What a bristle damps over mu, under a vibration of velocity amplitude `fast` [m/s] and `frequency` [rad/s]. It bends
 * over a path of 2 mu / sigma_0 after each of two reversals in a turn, and damps by the impulse of 2 mu sigma_1 /
 * sigma_0 per normal load; but by no more than sigma_1 v_q all the time. 0 of a rigid one. */
static inline double damping_share(const Bristle *bristle, double fast, double frequency) {
    if (!is_elastic(bristle)) {
        return 0.0;
    }
    double held = fmax(bristle->coefficient, 0.5 * PI * bristle->stiffness * fast / frequency);
    return bristle->damping * fast / held;
}

/* sigma_0 z of a bristle bent by `deflection` [m]; 0 of a rigid one. */
static inline double bristle_bent(const Bristle *bristle, double deflection) {
    return is_elastic(bristle) ? bristle->stiffness * deflection : 0.0;
}

/* sigma_0 z after `travel` [m] in one direction (its sign), from `friction` on. */
static inline double bristle_after(const Bristle *bristle, double friction, double travel) {
    double limit = travel >= 0.0 ? bristle->coefficient : -bristle->coefficient;
    double bent = elementary_expm1(-bristle->stiffness * fabs(travel) / bristle->coefficient);
    return friction - (limit - friction) * bent;
}
