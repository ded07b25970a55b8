/* Estimates of the error that averages make in the slow velocity. */
#ifndef SLIDER_SLOW_MOTION_ERROR_H
#define SLIDER_SLOW_MOTION_ERROR_H

#include <stdbool.h>

#include "law.h"

/* Share of mean friction in the inertia of the vibration, faces mu N0 / (Mt w v_q): the small number by
 * which averages expand. */
double friction_share(const Law *law);

/* Decay of the slow motion in a turn of the drive. */
double slow_decay_in_turn(const Law *law);

/* Decay of the resonator's own vibration in a turn of the drive, the slower of two; infinite without
 * resonator. */
double decay_in_turn(const Law *law);

/* Decay of the bend of a bristle in a turn, over a path of four times the amplitude; infinite without. */
double bristle_decay(const Law *law);

/* Error [m/s] of averages of first order. */
double first_order_error(const Law *law);

/* Error [m/s] of those of second order, by rule of thumb, where friction adds `added_mass`, a share of the total
 * mass, and friction and load leave a mean `force` [N]: without it motion is steady, and its orbit exact. */
double second_order_error(const Law *law, double added_mass, double force);

/* Error of tables in the scale of each quantity: that up to which the last coefficients of a panel are left. */
double table_accuracy(const Device *device);

/* Error [m/s] of the tables. */
double resolution_error(const Law *law);

/* Error [m/s] of resolved motion after a drive angle [rad]. */
double resolved_error(const Law *law, double angle);

/* What those err by besides [m/s], by rule of thumb, while the lead drifts by `drift` >= 0 [rad/s] over all turns
 * of an orbit. */
double drift_error(const Law *law, double drift);

/* The same while the load grows by `loading` [N/s]. */
double loading_error(const Law *law, double loading);

#endif
