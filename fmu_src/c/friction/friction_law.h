/* The interface of a friction law: a table of functions.
 *
 * A new law is a file that ends with its table, and an entry in friction_laws.c. */
#ifndef SLIDER_FRICTION_LAW_H
#define SLIDER_FRICTION_LAW_H

#include <stdbool.h>

#include "../base/refusal.h"
#include "../device/moment.h"
#include "averaged_friction.h"
#include "law.h"
#include "leg.h"

typedef struct FrictionLaw {
    /* Whether a slider at rest sticks: friction then balances the other forces. */
    bool sticks;

    /* Whether a bristle bends after each reversal, so that panels need tables. */
    bool bends;

    /* Refuses a device for which the law is not defined. */
    bool (*check)(const Device *device, Refusal *refusal);

    /* Friction of the bristle at the start, per unit load. */
    double (*first_bristle)(const Law *law);

    /* Friction of the bristle after a displacement [m] in one direction from a moment on, per unit load. */
    double (*bristle)(const Law *law, const Moment *begin, double travelled);

    /* Contact mode under the held inputs. */
    int (*mode)(const Law *law, const Moment *moment);

    /* Friction force [N] on the slider in contact mode `mode`, positive against +X. */
    double (*force)(const Law *law, const Moment *moment, int mode);

    /* Begin the leg that starts at `now`, in the contact mode of `now`, and follow it for up to `longest`
     * [s]. The contact lifts or touches down after `switching` [s]. */
    void (*follow)(Leg *leg, const Law *law, Moment *now, double longest, double switching);

    /* Change from the end of a finished leg to the next contact mode; `switches` is true where the
     * contact lifts or touches down there. */
    void (*succeed)(const Leg *leg, const Law *law, Moment *now, bool switches);

    const AveragedFriction *averaged;
} FrictionLaw;

extern const FrictionLaw COULOMB, LUGRE;

#endif
