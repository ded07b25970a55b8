#include "orbit_defect.h"

#include "elementary.h"
#include <string.h>

#include "orbit_equations.h"
#include "state.h"

/* Excess force of the maps, in the scale of forces: its squares are far above rounding, its cubes small. */
#define EXCESS 1e-2

/* Gauss's nodes and weights of the unit interval. */
enum { QUADRATURE_NODES = 4 };
static const double NODE[QUADRATURE_NODES] = {0.06943184420297371, 0.33000947820757187, 0.6699905217924281,
                                   0.9305681557970263};
static const double WEIGHT[QUADRATURE_NODES] = {0.17392742256872693, 0.32607257743127307, 0.32607257743127307,
                                     0.17392742256872693};

double decayed_integral(double decay, double n) {
    return decay == 0.0 ? n : -expm1(-decay * n) / decay;
}

double velocity_by_excess(const OrbitLinearisation *linear, double n) {
    return -linear->factor * decayed_integral(linear->factor * linear->slope, n);
}

/* Part of a period from the section of an orbit to a phase of LAG_PHASES. */
static double part_since(const PeriodMap *map, const HeldOrbit *orbit, int phase) {
    double part = (double)phase / LAG_PHASES - orbit->section.theta / (TAU * map->turns);
    return part - floor(part);
}

/* The way [m] of the pair's centre with the drive, against it. */
static double driven_way(const PeriodMap *map, double theta) {
    return map->fast.pair_velocity / map->law.held.plant.drive_frequency * sin(theta);
}

/* A passage on its way, under way from the section: from the phase `first` on. */
typedef struct {
    const PeriodMap *map;
    const HeldOrbit *orbit;
    int first;
    OrbitPassage *passage;
} Passing;

static void pass_phase(void *observer, int index, const State *state, double position) {
    const Passing *passing = observer;
    const PeriodMap *map = passing->map;
    const HeldOrbit *orbit = passing->orbit;
    OrbitPassage *passage = passing->passage;
    int phase = (passing->first + index) % LAG_PHASES;
    double theta = TAU * map->turns * phase / LAG_PHASES, length = map->period * map->speed;
    double way = position / length - orbit->velocity / map->speed * part_since(map, orbit, phase);
    double share = map->law.held.plant.mass_fraction, start = driven_way(map, orbit->section.theta);
    double centre = share * state->displacement + driven_way(map, theta) - start;
    passage->momentum[phase] = momentum_velocity(map, state, theta) / map->speed;
    passage->way[phase] = way;
    passage->section -= (way + centre / length) / LAG_PHASES;
}

bool orbit_pass(const PeriodMap *map, const HeldOrbit *orbit, const OrbitLinearisation *linear,
                double excess, OrbitPassage *passage) {
    OrbitEquations equations = {.map = map, .lead = orbit->lead, .theta = orbit->section.theta,
                                .stops = orbit->section.stops};
    Unknowns unknowns = unknowns_of(&equations, &orbit->section, -orbit->friction);
    Passing passing = {map, orbit, 0, passage};
    int states = map->states;
    for (int i = 0; i < states; i++) {
        unknowns.at[i] += excess * linear->lag[i];
    }
    unknowns.at[states] += excess;
    double load = map->force * unknowns.at[states];
    Moment section = section_of(&equations, &unknowns), after;
    for (int i = 1; i < LAG_PHASES; i++) {
        bool sooner = part_since(map, orbit, i) < part_since(map, orbit, passing.first);
        passing.first = sooner ? i : passing.first;
    }
    double first = part_since(map, orbit, passing.first) * map->period;
    Trace trace = {first, map->period / LAG_PHASES, LAG_PHASES, 0, pass_phase, &passing};
    passage->section = 0.0;
    if (!orbit_trace(map, orbit->lead, load, &section, map->period, &trace, &after)) {
        return false;
    }
    Unknowns end = unknowns_of(&equations, &after, load);
    memcpy(passage->values, end.at, (size_t)states * sizeof end.at[0]);
    passage->values[states] = after.position / (map->period * map->speed);
    return true;
}

bool orbit_probe(const PeriodMap *map, const HeldOrbit *orbit, OrbitProbe *probe) {
    OrbitPassage less, more, *same = &probe->passage, *by = &probe->by_excess;
    double jacobian[UNKNOWNS][UNKNOWNS];
    memcpy(jacobian, orbit->jacobian, sizeof jacobian);
    if (orbit->sticks || !linearise_orbit(jacobian, map->states, &probe->linear) ||
        !probe->linear.is_slow || !orbit_pass(map, orbit, &probe->linear, -EXCESS, &less) ||
        !orbit_pass(map, orbit, &probe->linear, 0.0, same) ||
        !orbit_pass(map, orbit, &probe->linear, EXCESS, &more)) {
        return false;
    }
    for (int i = 0; i < LAG_PHASES; i++) {
        probe->since[i] = part_since(map, orbit, i);
        by->momentum[i] = (more.momentum[i] - less.momentum[i]) / (2.0 * EXCESS);
        by->way[i] = (more.way[i] - less.way[i]) / (2.0 * EXCESS);
    }
    for (int i = 0; i <= map->states; i++) {
        double sum = more.values[i] + less.values[i] - 2.0 * same->values[i];
        by->values[i] = (more.values[i] - less.values[i]) / (2.0 * EXCESS);
        probe->squares[i] = 0.5 * sum / (EXCESS * EXCESS);
    }
    return true;
}

/* What the slow equation without h adds to v in a period by the square of the excess, and to its mean. */
static void slow_squares(const OrbitLinearisation *linear, const OrbitBend *bend, double *end,
                         double *mean) {
    double decay = linear->factor * linear->slope;
    *end = *mean = 0.0;
    for (int i = 0; i < QUADRATURE_NODES; i++) {
        double t = NODE[i], moved = velocity_by_excess(linear, t);
        double pull = bend->factor * moved * exp(-decay * t) +
                      0.5 * linear->factor * bend->slope * moved * moved;
        *end -= WEIGHT[i] * pull * exp(-decay * (1.0 - t));
        *mean -= WEIGHT[i] * pull * decayed_integral(decay, 1.0 - t);
    }
}

bool orbit_defect(const PeriodMap *map, const HeldOrbit *orbit, const OrbitProbe *probe,
                  const OrbitBend *bend, double *h) {
    const OrbitLinearisation *linear = &probe->linear;
    int states = map->states;
    double matrix[UNKNOWNS][UNKNOWNS] = {{0.0}}, right[UNKNOWNS] = {0.0};
    double end, mean, rho = linear->multiplier, moved = velocity_by_excess(linear, 1.0);
    double stretch = decayed_integral(linear->factor * linear->slope, 1.0);
    slow_squares(linear, bend, &end, &mean);
    double excess = linear->slope * end + 0.5 * bend->slope * moved * moved;
    for (int i = 0; i < states; i++) {
        for (int j = 0; j < states; j++) {
            matrix[i][j] = orbit->jacobian[i][j] + (i == j ? 1.0 - rho * rho : 0.0);
        }
        matrix[i][states] = -(linear->tangent[i] + linear->slope * linear->lag[i]) * rho * stretch;
        right[i] = linear->tangent[i] * end + 0.5 * bend->tangent[i] * moved * moved +
                   bend->lag[i] * moved * rho + linear->lag[i] * excess - probe->squares[i];
    }
    memcpy(matrix[states], orbit->jacobian[states], (size_t)states * sizeof right[0]);
    matrix[states][states] = -0.5 * stretch * stretch;
    right[states] = mean - probe->squares[states];
    if (!solve_linear(matrix, right, states + 1)) {
        return false;
    }
    *h = right[states];
    return isfinite(*h);
}
