#include "held_orbit.h"

#include <math.h>
#include <string.h>

#include "orbit_linearisation.h"
#include "state.h"

/* Correction of the unknowns in their scales up to which an orbit is found, and that up to which it is
 * where rounding ends its decrease. */
#define COULOMB_CONVERGED 1e-13
#define LUGRE_CONVERGED 1e-12
#define ROUNDED 1e-9

/* Steps of a Jacobian in the scales of the unknowns. */
#define COULOMB_STEP 1e-6
#define LUGRE_STEP 1e-5

/* Smallest part of a step that is tried. */
#define SMALLEST_PART 0.015

/* W, displacement and velocity of the resonator, friction of the bristle if there is one, load; each in
 * its scale. */
typedef struct {
    double at[UNKNOWNS];
} Unknowns;

/* The equations of an orbit: that the state repeats, and that the mean velocity, or where `loaded` the
 * load, is what is `given` in its scale. `maps` counts. */
typedef struct {
    const PeriodMap *map;
    double lead, given;
    bool loaded;
    int states, maps;
    Stops stops;
} Equations;

/* By how much the states change in a period, the mean velocity, and the moments at both ends. */
typedef struct {
    double values[UNKNOWNS];
    Moment section, after;
} Trial;

static Moment section_of(const Equations *equations, const Unknowns *unknowns) {
    const PeriodMap *map = equations->map;
    const Plant *plant = &map->law.held.plant;
    const double *at = unknowns->at;
    Moment section = {.stops = equations->stops};
    section.state.displacement = map->swing * at[1];
    section.state.rate = map->swing * plant->drive_frequency * at[2];
    section.state.velocity =
        map->speed * at[0] - plant->mass_fraction * section.state.rate - map->fast.pair_velocity;
    section.bristle = map->states > 3 ? map->law.bristle.coefficient * at[3] : 0.0;
    section_enter(map, equations->lead, &section);
    return section;
}

static Unknowns unknowns_of(const PeriodMap *map, const Moment *section, double load) {
    Unknowns unknowns = {{0.0}};
    unknowns.at[0] = section_momentum(map, &section->state) / map->speed;
    unknowns.at[1] = section->state.displacement / map->swing;
    unknowns.at[2] = section->state.rate / (map->swing * map->law.held.plant.drive_frequency);
    if (map->states > 3) {
        unknowns.at[3] = section->bristle / map->law.bristle.coefficient;
    }
    unknowns.at[map->states] = load / map->force;
    return unknowns;
}

static bool try_unknowns(Equations *equations, const Unknowns *unknowns, Trial *trial) {
    const PeriodMap *map = equations->map;
    int states = equations->states;
    double load = map->force * unknowns->at[states];
    trial->section = section_of(equations, unknowns);
    equations->maps++;
    if (!period_map_apply(map, equations->lead, load, &trial->section, &trial->after)) {
        return false;
    }
    Unknowns reached = unknowns_of(map, &trial->after, load);
    for (int i = 0; i < states; i++) {
        trial->values[i] = reached.at[i] - unknowns->at[i];
    }
    trial->values[states] = trial->after.position / (map->period * map->speed);
    return true;
}

/* The Jacobian of the values by differences about a trial. */
static bool differentiate(Equations *equations, const Unknowns *unknowns, const Trial *trial,
                          double jacobian[UNKNOWNS][UNKNOWNS]) {
    double step = equations->states > 3 ? LUGRE_STEP : COULOMB_STEP;
    for (int j = 0; j <= equations->states; j++) {
        Unknowns moved = *unknowns;
        Trial other;
        moved.at[j] += step;
        if (!try_unknowns(equations, &moved, &other)) {
            return false;
        }
        for (int i = 0; i <= equations->states; i++) {
            jacobian[i][j] = (other.values[i] - trial->values[i]) / (moved.at[j] - unknowns->at[j]);
        }
    }
    return true;
}

/* The step of Newton's method that leads from `values` at `unknowns` to 0 and to what is given. Returns
 * the largest entry; infinite where the Jacobian is singular. */
static double newton_step(const Equations *equations, double jacobian[UNKNOWNS][UNKNOWNS],
                          const double values[UNKNOWNS], const Unknowns *unknowns,
                          double step[UNKNOWNS]) {
    int last = equations->states;
    double matrix[UNKNOWNS][UNKNOWNS], largest = 0.0;
    memcpy(matrix, jacobian, sizeof matrix);
    for (int i = 0; i < last; i++) {
        step[i] = -values[i];
    }
    step[last] = equations->given - values[last];
    if (equations->loaded) {
        step[last] = equations->given - unknowns->at[last];
        for (int j = 0; j <= last; j++) {
            matrix[last][j] = j == last ? 1.0 : 0.0;
        }
    }
    if (!solve_linear(matrix, step, last + 1)) {
        return INFINITY;
    }
    for (int i = 0; i <= last; i++) {
        largest = fmax(largest, fabs(step[i]));
    }
    return isfinite(largest) ? largest : INFINITY;
}

/* Broyden's update: the Jacobian that takes `moved` to the change of the values, and is else the same. */
static void update_jacobian(double jacobian[UNKNOWNS][UNKNOWNS], int count,
                            const double moved[UNKNOWNS], const double before[UNKNOWNS],
                            const double after[UNKNOWNS]) {
    double square = 0.0;
    for (int j = 0; j < count; j++) {
        square += moved[j] * moved[j];
    }
    for (int i = 0; i < count; i++) {
        double missed = after[i] - before[i];
        for (int j = 0; j < count; j++) {
            missed -= jacobian[i][j] * moved[j];
        }
        for (int j = 0; j < count; j++) {
            jacobian[i][j] += missed * moved[j] / square;
        }
    }
}

static Unknowns advanced(const Unknowns *unknowns, const double step[UNKNOWNS], double part) {
    Unknowns next;
    for (int i = 0; i < UNKNOWNS; i++) {
        next.at[i] = unknowns->at[i] + part * step[i];
    }
    return next;
}

/* Newton's method from `unknowns`, damped, with `jacobian` kept as long as it serves; `fresh` where it was
 * taken at `unknowns`. Leaves unknowns, trial and Jacobian at the orbit. */
static OrbitStatus solve(Equations *equations, Unknowns *unknowns, Trial *trial,
                         double jacobian[UNKNOWNS][UNKNOWNS], bool fresh) {
    int count = equations->states + 1;
    double accuracy = equations->states > 3 ? LUGRE_CONVERGED : COULOMB_CONVERGED;
    double smallest_update = equations->states > 3 ? LUGRE_STEP : COULOMB_STEP;
    double before = INFINITY;
    while (equations->maps < MAX_MAPS) {
        double step[UNKNOWNS] = {0.0}, part = 1.0;
        double size = newton_step(equations, jacobian, trial->values, unknowns, step);
        if (size <= accuracy || (size <= ROUNDED && size > 0.5 * before)) {
            *unknowns = advanced(unknowns, step, 1.0);
            for (int j = 0; j < count; j++) {
                trial->values[count - 1] += jacobian[count - 1][j] * step[j];
            }
            return ORBIT_FOUND;
        }
        while (equations->maps < MAX_MAPS) {
            double left[UNKNOWNS] = {0.0}, contraction = INFINITY;
            Unknowns next = advanced(unknowns, step, part);
            Trial other;
            if (isfinite(size) && try_unknowns(equations, &next, &other)) {
                contraction = newton_step(equations, jacobian, other.values, &next, left) / size;
            }
            if (contraction <= 1.0 - 0.25 * part) {
                double moved[UNKNOWNS] = {0.0};
                for (int i = 0; i < count; i++) {
                    moved[i] = next.at[i] - unknowns->at[i];
                }
                if (part * size > smallest_update) {
                    update_jacobian(jacobian, count, moved, trial->values, other.values);
                }
                *unknowns = next;
                *trial = other;
                fresh = false;
                before = size;
                break;
            }
            if (size <= ROUNDED) {
                return ORBIT_FOUND;
            }
            if (!fresh) {
                if (!differentiate(equations, unknowns, trial, jacobian)) {
                    return ORBIT_NOT_CONVERGED;
                }
                fresh = true;
                break;
            }
            part *= 0.25;
            if (!(part > SMALLEST_PART)) {
                return ORBIT_NOT_CONVERGED;
            }
        }
    }
    return ORBIT_NOT_CONVERGED;
}

/* The vibration without friction: where the search begins that has no neighbour. */
static Unknowns vibration_alone(const Equations *equations) {
    const PeriodMap *map = equations->map;
    Moment section = {0};
    Response swing = steady_swing(map->fast.resonator, 0.0, map->law.held.plant.drive_frequency);
    double velocity = equations->loaded ? 0.0 : equations->given * map->speed;
    section.state.displacement = swing.displacement;
    section.state.rate = swing.rate;
    section.state.velocity = velocity - map->law.held.plant.mass_fraction * swing.rate -
                             map->fast.pair_velocity;
    return unknowns_of(map, &section, equations->loaded ? equations->given * map->force : 0.0);
}

static OrbitStatus find(Equations *equations, const HeldOrbit *neighbour, HeldOrbit *orbit) {
    const PeriodMap *map = equations->map;
    Unknowns unknowns;
    Trial trial;
    double jacobian[UNKNOWNS][UNKNOWNS] = {{0.0}};
    bool fresh = false;
    if (neighbour != NULL) {
        unknowns = unknowns_of(map, &neighbour->section, -neighbour->friction);
        memcpy(jacobian, neighbour->jacobian, sizeof jacobian);
        equations->stops = neighbour->section.stops;
        double values[UNKNOWNS] = {0.0}, step[UNKNOWNS] = {0.0};
        values[equations->states] = neighbour->velocity / map->speed;
        if (isfinite(newton_step(equations, jacobian, values, &unknowns, step))) {
            unknowns = advanced(&unknowns, step, 1.0);
        }
    } else {
        unknowns = vibration_alone(equations);
        if (map->states > 3 && try_unknowns(equations, &unknowns, &trial)) {
            unknowns.at[3] = trial.after.bristle / map->law.bristle.coefficient;
        }
    }
    if (!try_unknowns(equations, &unknowns, &trial)) {
        return ORBIT_NOT_CONVERGED;
    }
    if (neighbour == NULL) {
        fresh = differentiate(equations, &unknowns, &trial, jacobian);
        if (!fresh) {
            return ORBIT_NOT_CONVERGED;
        }
    }
    OrbitStatus status = solve(equations, &unknowns, &trial, jacobian, fresh);
    if (status != ORBIT_FOUND) {
        return status;
    }
    memset(orbit, 0, sizeof *orbit);
    orbit->lead = equations->lead;
    orbit->velocity = map->speed * (equations->loaded ? trial.values[equations->states]
                                                      : equations->given);
    orbit->friction = -map->force * unknowns.at[equations->states];
    equations->stops = trial.after.stops;
    orbit->section = section_of(equations, &unknowns);
    orbit->offset = map->speed * unknowns.at[0] - orbit->velocity;
    orbit->reversals = trial.after.counts.reversals;
    orbit->sticks = trial.after.counts.sticks > 0.0;
    memcpy(orbit->jacobian, jacobian, sizeof jacobian);
    orbit->factor = 1.0;
    return ORBIT_FOUND;
}

static OrbitStatus find_checked(Equations *equations, const HeldOrbit *neighbour,
                                HeldOrbit *orbit) {
    if (!(equations->map->law.device.damping_ratio > 0.0)) {
        return ORBIT_UNDAMPED;
    }
    return equations->map->speed > 0.0 ? find(equations, neighbour, orbit) : ORBIT_STILL;
}

OrbitStatus held_orbit_at(const PeriodMap *map, double lead, double velocity,
                          const HeldOrbit *neighbour, HeldOrbit *orbit) {
    Equations equations = {.map = map, .lead = lead, .given = velocity / map->speed,
                           .states = map->states};
    return find_checked(&equations, neighbour, orbit);
}

OrbitStatus steady_orbit_at(const PeriodMap *map, double lead, double load,
                            const HeldOrbit *neighbour, HeldOrbit *orbit) {
    Equations equations = {.map = map, .lead = lead, .given = load / map->force, .loaded = true,
                           .states = map->states};
    return find_checked(&equations, neighbour, orbit);
}

OrbitStatus held_orbit_linearise(const PeriodMap *map, HeldOrbit *orbit) {
    Equations equations = {.map = map, .lead = orbit->lead, .states = map->states,
                           .stops = orbit->section.stops, .maps = orbit->maps};
    Unknowns unknowns = unknowns_of(map, &orbit->section, -orbit->friction);
    OrbitLinearisation linear;
    Trial trial;
    if (!try_unknowns(&equations, &unknowns, &trial) ||
        !differentiate(&equations, &unknowns, &trial, orbit->jacobian) ||
        !linearise_orbit(orbit->jacobian, map->states, &linear)) {
        return ORBIT_NOT_CONVERGED;
    }
    orbit->maps = equations.maps;
    orbit->factor = linear.is_slow && !orbit->sticks ? linear.factor : 1.0;
    orbit->slope = linear.slope * map->force / map->speed;
    orbit->fast_multiplier = linear.fast_multiplier;
    return orbit->fast_multiplier < 1.0 ? ORBIT_FOUND : ORBIT_UNSTABLE;
}
