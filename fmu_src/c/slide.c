#include "slide.h"

void slide_begin(Slide *slide, const Held *held, int sign, const State *state, double theta,
                 double chi, KnownPhasors *known, int direction) {
    slide->splits = held->splits;
    if (held->splits) {
        if (!known->known) {
            *known = (KnownPhasors){true, phasors_of(&held->plant, theta, chi)};
        }
        split_slide_begin(&slide->form.split, &held->split, &held->plant, sign, state, theta, chi,
                          &known->phasors, direction);
    } else {
        regular_slide_begin(&slide->form.regular, &held->plant, sign, state, theta, chi, direction);
    }
}

Watch slide_watch(Slide *slide) {
    return slide->splits ? split_slide_watch(&slide->form.split)
                         : regular_slide_watch(&slide->form.regular);
}

double slide_travel(const void *motion, double t) {
    const Slide *slide = motion;
    return slide->splits ? split_slide_travel(&slide->form.split, t)
                         : regular_slide_travel(&slide->form.regular, t);
}

State slide_end(const Slide *slide, double t, double *travel, KnownPhasors *known) {
    known->known = false;
    return slide->splits ? split_slide_end(&slide->form.split, t, travel, known)
                         : regular_slide_end(&slide->form.regular, t, travel);
}
