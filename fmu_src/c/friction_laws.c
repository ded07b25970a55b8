#include <stddef.h>

#include "friction_law.h"

/* The friction laws in the order of `friction_law`. */
static const FrictionLaw *const FRICTION_LAWS[] = {&COULOMB, &LUGRE};

enum { FRICTION_LAW_COUNT = sizeof FRICTION_LAWS / sizeof FRICTION_LAWS[0] };

const FrictionLaw *friction_law_of(int number) {
    return number >= 0 && number < FRICTION_LAW_COUNT ? FRICTION_LAWS[number] : NULL;
}
