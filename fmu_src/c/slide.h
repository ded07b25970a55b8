/* Sliding or flight in closed form: the fast form if it serves the device, otherwise the regular one. */
#ifndef SLIDER_SLIDE_H
#define SLIDER_SLIDE_H

#include <stdbool.h>

#include "held.h"
#include "regular_slide.h"
#include "split_slide.h"

typedef struct {
    bool splits;
    union {
        SplitSlide split;
        RegularSlide regular;
    } form;
} Slide;

/* Motion with friction s (F0 + F1 sin(chi)), s = `sign`; its velocity is watched in `direction`,
 * unless that is 0. `held` must outlive the slide. */
void slide_begin(Slide *slide, const Held *held, int sign, const State *state, double theta,
                 double chi, KnownPhasors *known, int direction);

/* The velocity in the direction to watch. */
Watch slide_watch(Slide *slide);

/* Displacement of the slider after `t` [s], in m; a TravelFunction of a Slide. */
double slide_travel(const void *motion, double t);

/* State after `t` [s], the displacement [m] in `travel`, and the phasors if they are known. */
State slide_end(const Slide *slide, double t, double *travel, KnownPhasors *known);

#endif
