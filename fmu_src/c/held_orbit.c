#include "held_orbit.h"

#include <math.h>
#include <string.h>

#include "orbit_equations.h"
#include "orbit_linearisation.h"
#include "orbit_newton.h"
#include "state.h"

/* Difference of mean friction, over that of sliding, up to which orbits are the same. */
#define SAME_FRICTION 1e-6

/* Multiplier from which on motion leaves an orbit; 1, but for differences, where it slides on. */
#define NEUTRAL (1.0 + 1e-4)

/* Largest velocity against the direction of a section, in v_q, at which the section is used. */
#define SECTION_REACH 0.5

/* The vibration without friction at the section: the first guess without a neighbour. */
static Unknowns vibration_alone(const OrbitEquations *equations, int direction) {
    const PeriodMap *map = equations->map;
    const Plant *plant = &map->law.held.plant;
    Response swing = steady_swing(map->fast.resonator, equations->theta, plant->drive_frequency);
    double velocity = equations->loaded ? 0.0 : equations->given;
    Moment section = {.bristle = direction * map->law.bristle.coefficient};
    section.state.displacement = swing.displacement;
    section.state.rate = swing.rate;
    section.state.velocity = map->speed * (velocity + direction);
    double load = equations->loaded ? equations->given * map->force : 0.0;
    return unknowns_of(equations, &section, load);
}

/* The first guess on the tangent at a neighbour, and its Jacobian; false where that is singular. */
static bool along_tangent(OrbitEquations *equations, const HeldOrbit *neighbour,
                          Unknowns *unknowns, double jacobian[UNKNOWNS][UNKNOWNS]) {
    double values[UNKNOWNS] = {0.0}, step[UNKNOWNS] = {0.0};
    *unknowns = unknowns_of(equations, &neighbour->section, -neighbour->friction);
    memcpy(jacobian, neighbour->jacobian, sizeof neighbour->jacobian);
    equations->stops = neighbour->section.stops;
    values[equations->map->states] = neighbour->velocity / equations->map->speed;
    if (!isfinite(newton_step(equations, jacobian, values, unknowns, step))) {
        return false;
    }
    *unknowns = unknowns_after(unknowns, step, 1.0);
    return true;
}

/* Whether the slider stays at rest on a resonator that vibrates steadily. */
static bool stays_at_rest(const OrbitEquations *equations) {
    const PeriodMap *map = equations->map;
    const Plant *plant = &map->law.held.plant;
    double load = equations->loaded ? equations->given * map->force : 0.0;
    Complex swing =
        complex_scale(plant->base_acceleration, transfer(&plant->stick, plant->drive_frequency));
    Response start = steady_swing(swing, 0.0, plant->drive_frequency);
    Moment rest = {.state = {0.0, start.displacement, start.rate}}, after;
    orbit_enter(map, equations->lead, 0.0, &rest);
    return orbit_advance(map, equations->lead, load, &rest, map->period, &after) &&
           after.mode == STICK && after.position == 0.0;
}

static OrbitStatus find(OrbitEquations *equations, int direction, const HeldOrbit *neighbour,
                        HeldOrbit *orbit) {
    const PeriodMap *map = equations->map;
    int states = map->states;
    Unknowns unknowns;
    Trial trial;
    double jacobian[UNKNOWNS][UNKNOWNS] = {{0.0}};
    equations->theta = section_phase(map, direction);
    bool follows =
        neighbour != NULL && along_tangent(equations, neighbour, &unknowns, jacobian);
    if (!follows) {
        unknowns = vibration_alone(equations, direction);
    }
    if (!try_unknowns(equations, &unknowns, &trial) ||
        (!follows && !differentiate(equations, &unknowns, &trial, jacobian))) {
        return ORBIT_NOT_CONVERGED;
    }
    if (!solve_orbit(equations, &unknowns, &trial, jacobian, !follows)) {
        return stays_at_rest(equations) ? ORBIT_STILL : ORBIT_NOT_CONVERGED;
    }
    equations->stops = trial.after.stops;
    memset(orbit, 0, sizeof *orbit);
    orbit->lead = equations->lead;
    orbit->velocity = map->speed * (equations->loaded ? trial.values[states] : equations->given);
    orbit->friction = -map->force * unknowns.at[states];
    orbit->section = section_of(equations, &unknowns);
    orbit->direction = direction;
    orbit->reversals = trial.after.counts.reversals;
    orbit->sticks = trial.after.counts.sticks > 0.0;
    orbit->factor = 1.0;
    orbit->maps = equations->maps;
    memcpy(orbit->jacobian, jacobian, sizeof jacobian);
    if (!equations->loaded && orbit->reversals == 0.0 && !orbit->sticks) {
        orbit->friction = copysign(sliding_friction(map, equations->lead), orbit->velocity);
    }
    return ORBIT_FOUND;
}

/* The reason why no orbit can exist, or ORBIT_FOUND. */
static OrbitStatus precondition(const PeriodMap *map) {
    if (!(map->law.device.damping_ratio > 0.0)) {
        return ORBIT_UNDAMPED;
    }
    return map->speed > 0.0 ? ORBIT_FOUND : ORBIT_STILL;
}

/* Whether the section in `direction` may be used for orbits at `velocity` [m/s]. */
static bool section_serves(const PeriodMap *map, int direction, double velocity) {
    return direction * velocity > -SECTION_REACH * map->speed;
}

OrbitStatus held_orbit_at(const PeriodMap *map, double lead, double velocity,
                          const HeldOrbit *neighbour, HeldOrbit *orbit) {
    OrbitEquations equations = {.map = map, .lead = lead, .given = velocity / map->speed};
    OrbitStatus status = precondition(map);
    if (status != ORBIT_FOUND) {
        return status;
    }
    if (neighbour != NULL && section_serves(map, neighbour->direction, velocity)) {
        return find(&equations, neighbour->direction, neighbour, orbit);
    }
    return find(&equations, velocity >= 0.0 ? FORWARD : BACKWARD, NULL, orbit);
}

OrbitStatus steady_orbit_at(const PeriodMap *map, double lead, double load,
                            const HeldOrbit *neighbour, HeldOrbit *orbit) {
    OrbitEquations equations = {
        .map = map, .lead = lead, .given = load / map->force, .loaded = true};
    OrbitStatus status = precondition(map);
    if (status != ORBIT_FOUND) {
        return status;
    }
    int direction = neighbour != NULL ? neighbour->direction : FORWARD;
    status = find(&equations, direction, neighbour, orbit);
    if (status == ORBIT_FOUND && !section_serves(map, direction, orbit->velocity)) {
        HeldOrbit before = *orbit;
        status = held_orbit_at(map, lead, before.velocity, &before, orbit);
        status = status == ORBIT_FOUND ? find(&equations, orbit->direction, orbit, orbit) : status;
    }
    return status;
}

static SectionRate section_rate(const PeriodMap *map, double theta, const double change[UNKNOWNS],
                                double per) {
    OrbitEquations equations = {.map = map, .theta = theta};
    const Unknowns none = {{0.0}};
    Unknowns unknowns = none;
    for (int i = 0; i < map->states; i++) {
        unknowns.at[i] = change[i] / per;
    }
    Moment from = section_of(&equations, &none), to = section_of(&equations, &unknowns);
    return (SectionRate){{to.state.velocity - from.state.velocity, to.state.displacement,
                          to.state.rate},
                         to.bristle};
}

OrbitStatus held_orbit_linearise(const PeriodMap *map, HeldOrbit *orbit) {
    double theta = orbit->section.theta;
    OrbitEquations equations = {.map = map, .lead = orbit->lead, .theta = theta,
                                .maps = orbit->maps, .stops = orbit->section.stops};
    Unknowns unknowns = unknowns_of(&equations, &orbit->section, -orbit->friction);
    OrbitLinearisation linear;
    Trial trial;
    if (!try_unknowns(&equations, &unknowns, &trial) ||
        !differentiate(&equations, &unknowns, &trial, orbit->jacobian) ||
        !linearise_orbit(orbit->jacobian, map->states, &linear)) {
        return ORBIT_NOT_CONVERGED;
    }
    bool drifts = linear.is_slow && !orbit->sticks;
    orbit->maps = equations.maps;
    orbit->slope = linear.slope * map->force / map->speed;
    orbit->fast_multiplier = linear.fast_multiplier;
    orbit->tangent = section_rate(map, theta, linear.tangent, map->speed);
    if (drifts) {
        orbit->factor = linear.factor;
        orbit->lag = section_rate(map, theta, linear.lag, map->force);
    }
    orbit->linearised = true;
    if (!(orbit->fast_multiplier < 1.0)) {
        return ORBIT_UNSTABLE;
    }
    bool lags = map->states > 3 && !orbit->sticks && !linear.is_separate;
    return lags ? ORBIT_NOT_SLOW : ORBIT_FOUND;
}

OrbitStatus held_orbit_check_stable(const PeriodMap *map, const HeldOrbit *orbit) {
    OrbitEquations equations = {.map = map, .lead = orbit->lead, .theta = orbit->section.theta,
                                .stops = orbit->section.stops};
    Unknowns unknowns = unknowns_of(&equations, &orbit->section, -orbit->friction);
    double jacobian[UNKNOWNS][UNKNOWNS] = {{0.0}};
    Trial trial;
    if (!try_unknowns(&equations, &unknowns, &trial) ||
        !differentiate(&equations, &unknowns, &trial, jacobian)) {
        return ORBIT_NOT_CONVERGED;
    }
    return largest_multiplier(jacobian, map->states) < NEUTRAL ? ORBIT_FOUND : ORBIT_UNSTABLE;
}

bool is_same_orbit(const PeriodMap *map, const HeldOrbit *one, const HeldOrbit *other) {
    double sliding = sliding_friction(map, one->lead);
    return fabs(one->friction - other->friction) <= SAME_FRICTION * sliding;
}
