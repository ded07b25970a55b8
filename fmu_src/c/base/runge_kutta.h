/* An embedded Runge-Kutta pair for one velocity and its travel, whose rates depend on time and velocity. */
#pragma once

#include <stdbool.h>

/* Rates of the velocity and of the travel. */
typedef struct {
    double acceleration, travel;
} SlowRate;

/* Give the rates at time `t` and velocity `v`. Return false where there are none. */
typedef bool (*SlowRateFunction)(void *motion, double t, double v, SlowRate *rate);

/* Where an integration is: time, velocity and travel, and the rates there. */
typedef struct {
    double t, velocity, travel;
    SlowRate rate;
} SlowPoint;

/* A step to a point; `change` is that of the velocity, `error` its estimated error, `gain` the derivative of the
 * acceleration by the velocity, from two stages at the end, between which the acceleration has `risen`. */
typedef struct {
    SlowPoint to;
    double change, error, gain, risen;
} SlowStep;

/* Order of the solution of Dormand and Prince's pair 5(4), whose error is that of the other one. */
enum { ORDER = 5 };

/* One step of `h` from a point by that pair. Return false where the rates are not defined at a stage; `step` is then
 * undefined. */
bool runge_kutta_step(SlowRateFunction rate, void *motion, const SlowPoint *from, double h, SlowStep *step);

/* Factor by which the next step may be longer or shorter than one with this error. */
double step_growth(double error, double tolerance);
