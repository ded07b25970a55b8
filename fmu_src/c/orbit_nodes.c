#include "orbit_nodes.h"

#include <stddef.h>

#include "contact.h"
#include "elementary.h"
#include "orbit_newton.h"
#include "slow_motion_error.h"
#include "state.h"

/* Nodes in a row whose values a polynomial must have for it to hold, and minimum number of nodes of a panel. */
enum { HOLDING = 2, MIN_NODES = 6 };

/* Smallest factor by which a node reduces the miss: with less, the last node does not hold, and the panel is halved. */
#define GAIN_OF_NODE 4.0

/* Nodes from which on a polynomial is a better guess than the tangent at the next orbit. */
enum { GUESSING = 3 };

/* Sum of the last coefficients that are left out, in the accuracy: differences are noisy. */
#define NOISE 0.1

/* Added mass up to which it is left out under Coulomb friction. */
#define NO_ADDED_MASS 1e-6

/* The polynomial of a quantity, and its accuracy; by how much it missed the value at the last node, and the number of
 * nodes in a row at which it `held`. */
typedef struct {
    PanelSeries series;
    double accuracy, missed;
    int held;
} NodeValues;

/* The orbits at the first `count` nodes, and what tables have of them. */
typedef struct {
    int count;
    HeldOrbit orbit[ORBIT_NODES];
    NodeValues of[ORBIT_QUANTITIES];
} PanelOrbits;

/* Scale in which a quantity has to hold. */
static double scale_of(const PeriodMap *map, const OrbitCurve *curve, OrbitQuantity quantity) {
    double w = map->law.held.plant.drive_frequency;
    switch (quantity) {
    case ORBIT_FRICTION:
        return fabs(curve->beyond[1].of[ORBIT_FRICTION]) + fabs(curve->beyond[0].of[ORBIT_FRICTION]);
    case ORBIT_FACTOR:
        return 10.0;
    case ORBIT_OFFSET:
        return map->speed;
    case ORBIT_WAY:
        return map->speed / w;
    case ORBIT_DISPLACEMENT:
        return 10.0 * map->swing;
    case ORBIT_RATE:
        return 10.0 * map->swing * w;
    case ORBIT_BRISTLE:
        return 100.0 * map->law.bristle.coefficient;
    case ORBIT_QUANTITIES:
        break;
    }
    return INFINITY;
}

/* Whether a search without neighbour finds the same orbit. */
static bool is_the_only_one(const PeriodMap *map, const HeldOrbit *orbit, int *maps) {
    HeldOrbit other;
    if (held_orbit_at(map, orbit->lead, orbit->velocity, NULL, &other) != ORBIT_FOUND) {
        *maps += MAX_MAPS;
        return true;
    }
    *maps += other.maps;
    return is_same_orbit(map, orbit, &other);
}

static void add_value(NodeValues *values, double value) {
    values->missed = fabs(panel_series_add(&values->series, value));
    values->held = values->missed <= values->accuracy ? values->held + 1 : 0;
}

static bool holds(const NodeValues *values) {
    return values->held >= HOLDING;
}

/* The orbit found next to a place; NULL for none. */
static const HeldOrbit *nearest(const PanelOrbits *found, double x) {
    int best = 0;
    for (int i = 1; i < found->count; i++) {
        best = fabs(panel_node(i) - x) < fabs(panel_node(best) - x) ? i : best;
    }
    return found->count > 0 ? &found->orbit[best] : NULL;
}

/* An orbit by the polynomials, otherwise like its neighbour. */
static HeldOrbit guess_of(const PeriodMap *map, const PanelOrbits *found,
                          const HeldOrbit *neighbour, double x, double velocity) {
    HeldOrbit guess = *neighbour;
    double of[ORBIT_QUANTITIES];
    for (int q = 0; q < ORBIT_QUANTITIES; q++) {
        of[q] = panel_series_at(&found->of[q].series, x);
    }
    State *state = &guess.section.state;
    state->displacement = of[ORBIT_DISPLACEMENT];
    state->rate = of[ORBIT_RATE];
    state->velocity = velocity + of[ORBIT_OFFSET] -
                      map->law.held.plant.mass_fraction * of[ORBIT_RATE] -
                      map->fast.pair_velocity * cos(guess.section.theta);
    guess.section.bristle = of[ORBIT_BRISTLE];
    guess.velocity = velocity;
    guess.friction = of[ORBIT_FRICTION];
    return guess;
}

/* Finds the orbit at a place, where the velocity is this [m/s]. */
static OrbitStatus find_orbit(const PeriodMap *map, double lead, const PanelOrbits *found, double x,
                              double velocity, HeldOrbit *orbit) {
    const HeldOrbit *neighbour = nearest(found, x);
    if (found->count >= GUESSING) {
        HeldOrbit guess = guess_of(map, found, neighbour, x, velocity);
        if (held_orbit_at(map, lead, velocity, &guess, orbit) == ORBIT_FOUND) {
            return ORBIT_FOUND;
        }
    }
    return held_orbit_at(map, lead, velocity, neighbour, orbit);
}

/* Find the orbit at the next node. The first is the one halfway to grazing, where a search without neighbour is at
 * its best; at the other end such a search must find the same orbit. The added mass is found as long as it does not
 * hold; under Coulomb friction it is left out where it is negligible at the first node. Counts the maps. */
static bool add_node(OrbitPanel *panel, const OrbitCurve *curve, const PeriodMap *map, int side,
                     PanelOrbits *found) {
    int node = found->count;
    double width = PI / (BASE_PANELS << panel->depth), x = panel_node(node);
    double velocity =
        curve->middle + curve->reach * cos((panel->index + 0.5 + 0.5 * side * x) * width);
    bool checked = panel->depth == 0 && node == PASSING_NODES - 1;
    HeldOrbit *orbit = &found->orbit[node];
    NodeValues *factor = &found->of[ORBIT_FACTOR], *way = &found->of[ORBIT_WAY];
    bool lags = !holds(factor), moves = !holds(way);
    OrbitStatus status = find_orbit(map, curve->lead, found, x, velocity, orbit);
    if (status == ORBIT_FOUND && (lags || checked)) {
        status = held_orbit_linearise(map, orbit);
    }
    OrbitPoint point;
    if (status == ORBIT_FOUND) {
        point = orbit_section_point(map, orbit);
    }
    if (status != ORBIT_FOUND || (moves && !orbit_way(map, orbit, &point.of[ORBIT_WAY]))) {
        panel->maps += MAX_MAPS;
        return false;
    }
    panel->maps += orbit->maps + moves;
    if (orbit->direction != panel->direction ||
        (checked && !is_the_only_one(map, orbit, &panel->maps))) {
        return false;
    }
    bool coulomb = map->law.device.friction_law == 0;
    if (coulomb && node == 0 && fabs(orbit->factor - 1.0) <= NO_ADDED_MASS) {
        add_value(factor, 1.0);
        factor->held = HOLDING;
        lags = false;
    }
    for (int q = 0; q < ORBIT_QUANTITIES; q++) {
        if ((q != ORBIT_FACTOR || lags) && (q != ORBIT_WAY || moves)) {
            add_value(&found->of[q], point.of[q]);
        }
    }
    found->count++;
    return true;
}

static bool all_hold(const PanelOrbits *found) {
    bool all = found->count >= MIN_NODES;
    for (int q = 0; q < ORBIT_QUANTITIES; q++) {
        all = all && holds(&found->of[q]);
    }
    return all;
}

/* Whether further nodes will not do. */
static bool is_hopeless(const PanelOrbits *found) {
    bool hopeless = found->count == ORBIT_NODES;
    double left = pow(GAIN_OF_NODE, ORBIT_NODES - 1 - found->count);
    for (int q = 0; q < ORBIT_QUANTITIES; q++) {
        const NodeValues *values = &found->of[q];
        bool misses = !holds(values) && values->missed > left * values->accuracy;
        hopeless = hopeless || (misses && found->count >= MIN_NODES);
    }
    return hopeless;
}

/* Leave out the last coefficients, as many as add up to no more than `noise`. */
static void leave_out_noise(double coefficient[ORBIT_NODES], double noise) {
    double left = noise;
    for (int k = ORBIT_NODES - 1; k > 0 && fabs(coefficient[k]) <= left; k--) {
        left -= fabs(coefficient[k]);
        coefficient[k] = 0.0;
    }
}

void orbit_panel_make(OrbitPanel *panel, const OrbitCurve *curve, const PeriodMap *map) {
    PanelOrbits found = {.count = 0};
    double accuracy = table_accuracy(&curve->device);
    for (int q = 0; q < ORBIT_QUANTITIES; q++) {
        found.of[q].accuracy = accuracy * scale_of(map, curve, (OrbitQuantity)q);
    }
    int side = (panel->index >> panel->depth) % 2 == 1 ? -1 : 1;
    panel->found = true;
    panel->holds = false;
    while (panel->found && !panel->holds && !is_hopeless(&found)) {
        panel->found = add_node(panel, curve, map, side, &found);
        panel->holds = panel->found && all_hold(&found);
    }
    if (!panel->found) {
        panel->holds = panel->depth >= MAX_DEPTH_MISSING;
        return;
    }
    panel->holds = panel->holds || panel->depth >= MAX_DEPTH;
    for (int q = 0; q < ORBIT_QUANTITIES; q++) {
        panel_series_chebyshev(&found.of[q].series, side, panel->coefficient[q]);
        leave_out_noise(panel->coefficient[q], NOISE * found.of[q].accuracy);
    }
    orbit_panel_end(panel);
}
