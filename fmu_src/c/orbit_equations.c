#include "orbit_equations.h"

#include "elementary.h"
#include <string.h>

Moment section_of(const OrbitEquations *equations, const Unknowns *unknowns) {
    const PeriodMap *map = equations->map;
    const Plant *plant = &map->law.held.plant;
    const double *at = unknowns->at;
    Moment section = {.stops = equations->stops};
    section.state.displacement = map->swing * at[1];
    section.state.rate = map->swing * plant->drive_frequency * at[2];
    section.state.velocity =
        map->speed * at[0] - plant->mass_fraction * section.state.rate -
        map->fast.pair_velocity * cos(equations->theta);
    section.bristle = map->states > 3 ? map->law.bristle.coefficient * at[3] : 0.0;
    orbit_enter(map, equations->lead, equations->theta, &section);
    return section;
}

Unknowns unknowns_of(const OrbitEquations *equations, const Moment *section, double load) {
    const PeriodMap *map = equations->map;
    Unknowns unknowns = {{0.0}};
    unknowns.at[0] = momentum_velocity(map, &section->state, equations->theta) / map->speed;
    unknowns.at[1] = section->state.displacement / map->swing;
    unknowns.at[2] = section->state.rate / (map->swing * map->law.held.plant.drive_frequency);
    if (map->states > 3) {
        unknowns.at[3] = section->bristle / map->law.bristle.coefficient;
    }
    unknowns.at[map->states] = load / map->force;
    return unknowns;
}

/* Largest unknown, in its scale, that is mapped: beyond, no orbit is near, and numbers overflow. */
#define MAX_UNKNOWN 1e4

bool try_unknowns(OrbitEquations *equations, const Unknowns *unknowns, Trial *trial) {
    const PeriodMap *map = equations->map;
    int states = equations->map->states;
    double load = map->force * unknowns->at[states];
    for (int i = 0; i <= states; i++) {
        if (!(fabs(unknowns->at[i]) <= MAX_UNKNOWN)) {
            return false;
        }
    }
    trial->section = section_of(equations, unknowns);
    equations->maps++;
    if (!orbit_advance(map, equations->lead, load, &trial->section, map->period,
                       &trial->after)) {
        return false;
    }
    Unknowns reached = unknowns_of(equations, &trial->after, load);
    for (int i = 0; i < states; i++) {
        trial->values[i] = reached.at[i] - unknowns->at[i];
    }
    trial->values[states] = trial->after.position / (map->period * map->speed);
    return true;
}

bool differentiate(OrbitEquations *equations, const Unknowns *unknowns, const Trial *trial,
                          double jacobian[UNKNOWNS][UNKNOWNS]) {
    for (int j = 0; j <= equations->map->states; j++) {
        Unknowns moved = *unknowns;
        Trial other;
        moved.at[j] += DIFFERENCE;
        if (!try_unknowns(equations, &moved, &other)) {
            return false;
        }
        for (int i = 0; i <= equations->map->states; i++) {
            jacobian[i][j] = (other.values[i] - trial->values[i]) / (moved.at[j] - unknowns->at[j]);
        }
    }
    return true;
}

double newton_step(const OrbitEquations *equations, double jacobian[UNKNOWNS][UNKNOWNS],
                          const double values[UNKNOWNS], const Unknowns *unknowns,
                          double step[UNKNOWNS]) {
    int last = equations->map->states;
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

