/* The choice of the friction law, and the law that follows. */
#ifndef SLIDER_FRICTION_LAWS_H
#define SLIDER_FRICTION_LAWS_H

#include <stdbool.h>

#include "../base/refusal.h"
#include "law.h"

/* Prepare all of a law but its motion and caches, by the number `friction_law` of the device. Refuses where device and
 * friction law do not fit; `law` is then undefined. */
bool law_prepare(Law *law, const Device *device, const Inputs *inputs, Refusal *refusal);

#endif
