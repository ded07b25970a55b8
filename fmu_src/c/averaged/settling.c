#include "settling.h"

#include <math.h>

/* Distance from balance, in fast velocities, at which motion settles: well above the error of the steps
 * before, and so short that forces are linear over it. */
#define NEAR 1e-7

/* Number of time constants of the approach that the time left must exceed. */
#define SETTLED 20.0

enum { MAX_SECANTS = 40 };

/* The velocity between `low` and `high` [m/s] at which the acceleration falls through 0: regula falsi with
 * the Illinois rule, which halves the weight of an end that stays. */
static double balance_between(AccelerationFunction acceleration, const void *motion, double low,
                              double at_low, double high, double at_high) {
    double root = low, before;
    int side = 0;
    for (int i = 0; i < MAX_SECANTS; i++) {
        before = root;
        root = low + (high - low) * (at_low / (at_low - at_high));
        double at_root = acceleration(motion, 0.0, root);
        if (at_root == 0.0 || root == before || !(low < root && root < high)) {
            break;
        }
        if (at_root > 0.0) {
            low = root;
            at_low = at_root;
            at_high *= side > 0 ? 0.5 : 1.0;
            side = 1;
        } else {
            high = root;
            at_high = at_root;
            at_low *= side < 0 ? 0.5 : 1.0;
            side = -1;
        }
    }
    return root;
}

bool is_settled(AccelerationFunction acceleration, const void *motion, double fast, double noise,
                const Reached *now) {
    double v = now->velocity, beside = NEAR * fast;
    return fabs(acceleration(motion, now->t, v)) <= noise &&
           acceleration(motion, now->t, v - beside) > 0.0 &&
           acceleration(motion, now->t, v + beside) < 0.0;
}

bool settle(AccelerationFunction acceleration, const void *motion, double fast, double end,
            Reached *now) {
    double low = now->velocity - NEAR * fast, high = now->velocity + NEAR * fast;
    double left = end - now->t;
    double at_low = acceleration(motion, 0.0, low), at_high = acceleration(motion, 0.0, high);
    double rate = (at_low - at_high) / (high - low);
    if (!(at_low > 0.0 && at_high < 0.0 && rate * left > SETTLED)) {
        return false;
    }
    double balance = balance_between(acceleration, motion, low, at_low, high, at_high);
    now->moved += balance * left + (now->velocity - balance) / rate;
    now->velocity = balance;
    now->t = end;
    return true;
}
