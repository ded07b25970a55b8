/* Sticking: the slider rests, the resonator swings against it, and the force needed to hold the slider is compared with
 * what friction can supply. */
#pragma once

#include "../base/first_zero.h"
#include "moment.h"

/* Motion while |needed force| stays within the limit F0 + F1 sin(chi). `direct` is the part of the needed force that
 * follows the drive, `normal` the changing part of the limit, both complex amplitudes [N].
 *
 * The resonator moves freely from `free_start` on, with the steady response `steady` [m] to its `forcing` [m/s^2] or,
 * where it `resonates`, the response from rest; curvature bounds then hold for `horizon` [s]. */
typedef struct {
    const Plant *plant;
    Complex direct, normal, forcing, steady;
    double fixed_bound, horizon;
    bool resonates;
    Response free_start;
} Stick;

/* Begin at `now`; `plant` must outlive the stick. */
void stick_begin(Stick *stick, const Plant *plant, const Moment *now);

/* Watch the forward margin (limit - needed force), then the backward margin (limit + needed force), for up to `longest`
 * [s]. Return the number of watches: 0 where the needed force is 0, or always below the smallest limit. */
int stick_watches(Stick *stick, double longest, Watch watches[2]);

/* State after `t` [s]. */
State stick_state(const Stick *stick, double t);
