/* What has changed since the last step of averaged motion of second order. */
#ifndef SLIDER_ORBIT_CHANGES_H
#define SLIDER_ORBIT_CHANGES_H

#include <stdbool.h>

#include "law.h"

/* `shaken` is the vibration: by another drive, or by a step with first-order averages. `tuned` is the contact,
 * `led` the lead of the normal load, `loaded` the load and `turned` the frequency ratio. The lead `drifts` where the
 * ratio is next to one with a phase that stands. */
typedef struct {
    bool shaken, tuned, led, loaded, turned, drifts;
} OrbitChanges;

/* What a held orbit depends on, at present. */
OrbitValues orbit_values_of(const Law *law);

/* Compares present values with those of the last step, and takes note of them. */
OrbitChanges orbit_note_changes(const Law *law, OrbitState *orbit);

#endif
