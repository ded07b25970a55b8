/* Held orbits: the periodic motion of the full device whose mean velocity is held at V.
 *
 * The load that holds it is L = -F2(V), F2 the mean friction. The unknowns are the state at the section
 * and L; the equations are that the state repeats after a period, and that the displacement in a period
 * is V times the period. This fixed point of the period map is found by Newton's method, with sliding,
 * sticking and flight alike. */
#ifndef SLIDER_HELD_ORBIT_H
#define SLIDER_HELD_ORBIT_H

#include "linear_system.h"
#include "moment.h"
#include "period_map.h"

/* Whether there is an orbit, or why there is none:
 *
 * UNDAMPED: without damping the start of the resonator never decays. STILL: nothing vibrates, or
 * friction holds the slider at rest throughout. NOT_CONVERGED: Newton's method does not converge.
 * UNSTABLE: the vibration about the orbit does not decay. RUNS_AWAY: the load exceeds all friction,
 * so that no velocity is steady. UNDETERMINED: the load leaves several velocities steady, or several motions
 * one velocity. NOT_SLOW: bristles follow no faster than the velocity changes. */
typedef enum {
    ORBIT_FOUND,
    ORBIT_UNDAMPED,
    ORBIT_STILL,
    ORBIT_NOT_CONVERGED,
    ORBIT_UNSTABLE,
    ORBIT_RUNS_AWAY,
    ORBIT_UNDETERMINED,
    ORBIT_NOT_SLOW
} OrbitStatus;

/* A change of the state at the section and of the friction of the bristle there. */
typedef struct {
    State state;
    double bristle;
} SectionRate;

/* An orbit of mean velocity [m/s] and mean friction F2 [N], `lead` [rad] being the phase of the
 * normal load at drive phase 0.
 *
 * `section` is the moment at the section, in `direction`; motion from there on under the load -friction
 * is the orbit. `reversals` is their number in a period; `sticks`: the slider sticks in a period. `maps`
 * is the number of period maps that it took. `jacobian` is that of its equations, in their scales.
 *
 * Known once it is `linearised`: `factor` 1 + kappa_m, 1 until then and where the slider sticks;
 * `slope` F2' = dF2/dV [N s/m]; `fast_multiplier`, the largest multiplier of a period of the vibration
 * about the orbit; `tangent`, the derivative of the section by velocity [m/s]; `lag`, the change of the
 * section in a motion that drifts, per excess force F2 + load [N]. */
typedef struct {
    double lead, velocity, friction;
    int direction;
    Moment section;
    double reversals;
    bool sticks, linearised;
    int maps;
    double jacobian[UNKNOWNS][UNKNOWNS];
    double factor, slope, fast_multiplier;
    SectionRate tangent, lag;
} HeldOrbit;

/* Finds the orbit at `velocity` [m/s], starting from a neighbour unless that is NULL; `orbit` may be the
 * neighbour. It is undefined unless the status is ORBIT_FOUND. */
OrbitStatus held_orbit_at(const PeriodMap *map, double lead, double velocity,
                          const HeldOrbit *neighbour, HeldOrbit *orbit);

/* Finds the orbit that `load` [N] holds: the steady motion under this load. */
OrbitStatus steady_orbit_at(const PeriodMap *map, double lead, double load,
                            const HeldOrbit *neighbour, HeldOrbit *orbit);

/* Linearises an orbit, at the cost of one map more than it has unknowns. LuGre friction needs this always,
 * Coulomb friction for slope, lag and low damping. */
OrbitStatus held_orbit_linearise(const PeriodMap *map, HeldOrbit *orbit);

/* ORBIT_UNSTABLE where motion under the load of the orbit leaves it; at the same cost. */
OrbitStatus held_orbit_check_stable(const PeriodMap *map, const HeldOrbit *orbit);

/* Whether two orbits of one lead and velocity are the same: their friction is. */
bool is_same_orbit(const PeriodMap *map, const HeldOrbit *one, const HeldOrbit *other);

#endif
