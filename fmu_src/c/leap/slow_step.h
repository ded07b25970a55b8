/* Steps of the slow motion: from here to a landing, a whole number of periods later. */
#pragma once

#include "slow_path.h"

/* What a step passed: a number of periods, and a travel [m]; by which factor it changed an earlier error of the slow
 * velocity, and the error [m/s] that it added. */
typedef struct {
    double periods, travel, factor, error;
} PathStep;

/* Fewest periods of a step: its points map half as many. */
#define SHORTEST_STEP (12.0 * DIFFERENCES)

/* One step of `h` periods where rates do not depend on time but for the slow velocity: they are interpolated. `last` is
 * then the landing. Return false where there are no rates or too many points would be needed; `h` becomes what to try
 * next. */
bool interpolated_step(SlowPath *path, double *h, PathStep *result);

/* Number of periods from period `n` on in which the load's phase drifts by an eighth of a beat: the stages of a step of
 * so many see all phases. */
double periods_in_beat(const PeriodMap *map, double n);

/* Number of periods of an embedded step that may be expected to hold here. */
double expected_step(const SlowPath *path);

/* One step of at most `h` periods, by an embedded Runge-Kutta pair. `last` is then the landing. Return false where
 * there are no rates, or its error is too large; `h` becomes what to try next. */
bool embedded_step(SlowPath *path, double *h, PathStep *result);
