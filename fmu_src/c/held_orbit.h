/* Held orbits: the periodic motion of the full device whose mean velocity is held at V.
 *
 * The load that holds it is L = -F2(V), F2 the mean friction. Unknown are the state at the section
 * and L, given that the state repeats after a period and that the way in it is V times the period:
 * a fixed point of the period map, found by Newton's method, with sliding, sticking and flight
 * alike. */
#ifndef SLIDER_HELD_ORBIT_H
#define SLIDER_HELD_ORBIT_H

#include "linear_system.h"
#include "moment.h"
#include "period_map.h"

/* Maps that an orbit may take, Jacobians included, before it counts as not found. */
enum { MAX_MAPS = 120 };

/* Whether there is an orbit, or why there is none:
 *
 * UNDAMPED: without damping the resonator never forgets its start. STILL: nothing vibrates, or
 * friction holds the slider at rest throughout. NOT_CONVERGED: Newton's method does not settle.
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
 * `section` is the moment at the section, in `direction`: motion under the load -friction goes on
 * from there. `reversals` in a period, and whether the slider `sticks` in it. `maps` is how often
 * the period was mapped for this orbit. `jacobian` is that of its equations, in their scales.
 *
 * Known once it is `linearised`: `factor` 1 + kappa_m, 1 until then and where the slider sticks;
 * `slope` F2' = dF2/dV [N s/m]; `fast_multiplier`, the largest one by which vibration about the
 * orbit decays in a period; `tangent` by velocity [m/s]; and the `lag` of a motion that drifts, by
 * the excess F2 + load [N] of force. */
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

/* Finds the orbit at `velocity` [m/s], from that of a neighbour unless it is NULL; `orbit` may be
 * the neighbour. It is undefined unless the status is ORBIT_FOUND. */
OrbitStatus held_orbit_at(const PeriodMap *map, double lead, double velocity,
                          const HeldOrbit *neighbour, HeldOrbit *orbit);

/* Finds the orbit in which `load` [N] is the one that holds: the steady motion under it. */
OrbitStatus steady_orbit_at(const PeriodMap *map, double lead, double load,
                            const HeldOrbit *neighbour, HeldOrbit *orbit);

/* Adds what is known once an orbit is linearised, at the cost of as many maps as it has unknowns,
 * and one: needed under LuGre friction, and under Coulomb friction for slope, lag and low damping. */
OrbitStatus held_orbit_linearise(const PeriodMap *map, HeldOrbit *orbit);

/* ORBIT_UNSTABLE where motion under the load of the orbit leaves it; at the same cost. */
OrbitStatus held_orbit_check_stable(const PeriodMap *map, const HeldOrbit *orbit);

/* Whether two orbits of one lead and velocity are the same: their friction is. */
bool is_same_orbit(const PeriodMap *map, const HeldOrbit *one, const HeldOrbit *other);

#endif
