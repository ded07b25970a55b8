/* The equations of a periodic motion: the state repeats after a period, and its mean velocity or
 * its load is given.
 *
 * All numbers are in the scales of the period map. */
#ifndef SLIDER_ORBIT_EQUATIONS_H
#define SLIDER_ORBIT_EQUATIONS_H

#include <stdbool.h>

#include "linear_system.h"
#include "moment.h"
#include "period_map.h"

/* Step of a Jacobian in the scales of the unknowns. */
#define DIFFERENCE 1e-6

/* The states at the section, which are W, displacement and velocity of the resonator and under
 * LuGre friction the friction of the bristle; after them the load. */
typedef struct {
    double at[UNKNOWNS];
} Unknowns;

/* At drive phase `theta` [rad] of the section, with stops expected at `stops`. `given` is the mean
 * velocity, or where `loaded` the load. `maps` counts. */
typedef struct {
    const PeriodMap *map;
    double lead, theta, given;
    bool loaded;
    int maps;
    Stops stops;
} OrbitEquations;

/* What unknowns lead to: by how much the states change in a period, and then the mean velocity; the
 * moments at both ends. */
typedef struct {
    double values[UNKNOWNS];
    Moment section, after;
} Trial;

/* The moment at the section. */
Moment section_of(const OrbitEquations *equations, const Unknowns *unknowns);

/* The unknowns that a moment at the section and a load [N] stand for. */
Unknowns unknowns_of(const OrbitEquations *equations, const Moment *section, double load);

/* Maps the period. False where that fails. */
bool try_unknowns(OrbitEquations *equations, const Unknowns *unknowns, Trial *trial);

/* The Jacobian of the values by differences, from the trial of `unknowns` on. False as above. */
bool differentiate(OrbitEquations *equations, const Unknowns *unknowns, const Trial *trial,
                   double jacobian[UNKNOWNS][UNKNOWNS]);

/* The step of Newton's method that leads from `values` at `unknowns` to what is asked for. Returns
 * its largest entry; infinite where the Jacobian is singular. */
double newton_step(const OrbitEquations *equations, double jacobian[UNKNOWNS][UNKNOWNS],
                   const double values[UNKNOWNS], const Unknowns *unknowns,
                   double step[UNKNOWNS]);

#endif
