#include "friction_laws.h"

#include <stddef.h>

#include "friction_law.h"

/* The friction laws in the order of `friction_law`. */
static const FrictionLaw *const FRICTION_LAWS[] = {&COULOMB, &LUGRE};

enum { FRICTION_LAW_COUNT = sizeof FRICTION_LAWS / sizeof FRICTION_LAWS[0] };

/* The law with this `friction_law` of the interface, or NULL. */
static const FrictionLaw *friction_law_of(int number) {
    return number >= 0 && number < FRICTION_LAW_COUNT ? FRICTION_LAWS[number] : NULL;
}

bool law_prepare(Law *law, const Device *device, const Inputs *inputs, Refusal *refusal) {
    law->device = *device;
    law->inputs = *inputs;
    law->middle_ratio = inputs->frequency_ratio;
    law->bristle = bristle_of(device);
    law->table = NULL;
    law->bending = NULL;
    law->motion = NULL;
    law->friction = friction_law_of(device->friction_law);
    if (law->friction == NULL) {
        return refuse(refusal, "friction_law = %d refused: no law has this number",
                      device->friction_law);
    }
    return law->friction->check(device, refusal) &&
           held_prepare(&law->held, device, inputs, refusal);
}
