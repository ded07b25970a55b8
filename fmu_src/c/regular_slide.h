/* Sliding or flight in forms that stay regular everywhere: at resonance without damping, at and
 * above critical damping, and for slow, constant or reversed normal loads.
 *
 * The slider follows from the momentum of the pair and the motion of the resonator. */
#ifndef SLIDER_REGULAR_SLIDE_H
#define SLIDER_REGULAR_SLIDE_H

#include "first_zero.h"
#include "forced_oscillator.h"
#include "plant.h"
#include "state.h"

/* Motion with friction s (F0 + F1 sin(chi)), s = 1, -1, or 0 in flight. `pair` are the sinusoidal parts of
 * the acceleration [m/s^2] of the pair by outer forces; the rest is a `deceleration` that grows by
 * `deceleration_rate` [m/s^3]. `pair_bound` and `own_bound` [m/s^3] bound the rate at which outer forces
 * change the acceleration of the pair, and of the slider alone. */
typedef struct {
    const Plant *plant;
    int direction;
    State start;
    double deceleration, deceleration_rate, pair_bound, own_bound;
    Forcing pair[FORCINGS];
    ForcedOscillator resonator;
} RegularSlide;

/* The velocity is watched in `direction`, unless that is 0. `plant` must outlive the slide. */
void regular_slide_begin(RegularSlide *slide, const Plant *plant, int sign, const State *state,
                         double theta, double chi, int direction);

/* The velocity in the direction to watch. */
Watch regular_slide_watch(RegularSlide *slide);

/* Displacement of the slider after `t` [s], in m. */
double regular_slide_travel(const RegularSlide *slide, double t);

/* State after `t` [s], and the displacement [m] in `travel`. */
State regular_slide_end(const RegularSlide *slide, double t, double *travel);

#endif
