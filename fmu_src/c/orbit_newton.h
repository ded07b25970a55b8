/* Newton's method for the equations of an orbit: damped, with Broyden's updates of the Jacobian. */
#ifndef SLIDER_ORBIT_NEWTON_H
#define SLIDER_ORBIT_NEWTON_H

#include <stdbool.h>

#include "orbit_equations.h"

/* Maps that an orbit may take, Jacobians included, before it counts as not found. */
enum { MAX_MAPS = 120 };

/* The unknowns after a `part` of a step. */
Unknowns unknowns_after(const Unknowns *unknowns, const double step[UNKNOWNS], double part);

/* Solve from `unknowns` and their `trial` on, with `jacobian` kept as long as it contracts; `fresh`: it was
 * taken at `unknowns`. Leaves unknowns, trial and Jacobian at the orbit. Returns false, with these
 * undefined, where the iteration does not converge within the largest number of maps. */
bool solve_orbit(OrbitEquations *equations, Unknowns *unknowns, Trial *trial,
                 double jacobian[UNKNOWNS][UNKNOWNS], bool fresh);

#endif
