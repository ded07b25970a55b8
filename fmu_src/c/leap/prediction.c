#include "prediction.h"

#include <math.h>
#include <string.h>

#include "../base/linear_system.h"
#include "../base/number.h"
#include "../device/vibrating_load.h"
#include "../friction/law.h"
#include "period_map.h"

/* Largest number of turns after which the normal load may repeat. */
enum { MAX_TURNS_OF_LOAD = 32 };

int turns_of_load(const Law *law) {
    if (law->device.normal_amplitude == 0.0) {
        return 1;
    }
    double ratio = law->inputs.frequency_ratio;
    for (int turns = 1; turns <= MAX_TURNS_OF_LOAD; turns++) {
        if (fabs(turns * ratio - nearbyint(turns * ratio)) <= EXACT) {
            return turns;
        }
    }
    return 0;
}

/* Unknowns, each over its scale: slow velocity, fast states and, for blocked motion, the load. */
enum { VELOCITY, FIRST_FAST };

/* Change of an unknown by which derivatives are taken. */
#define BESIDE 1e-6

/* Largest change of an unknown in an iteration, and the change at which the iteration ends: as it converges quadratically, the
 * next change would be rounding. Number of iterations. */
#define MAX_CHANGE 0.2
#define CONVERGED 1e-10
enum { MAX_ITERATIONS = 16 };

/* Squarings of the linear map after which it must have decayed: in 2^24 periods, more than rounding of its derivatives could
 * make it. */
enum { SQUARINGS = 24 };
#define DECAYED 0.5

/* A periodic motion that is looked for: `count` unknowns. */
typedef struct {
    PeriodMap map;
    Moment like;
    double psi;
    bool blocked;
    int count;
} Search;

/* What a period changes: velocity, fast states and, for blocked motion, the position, each over its scale. `travel` [m] is the
 * displacement in the period. Return false where there is no motion. */
static bool change_in_period(Search *search, const double unknowns[UNKNOWNS],
                             double change[UNKNOWNS], double *travel) {
    PeriodMap *map = &search->map;
    int fast_count = map->fast_count;
    double fast[MAX_FAST] = {0.0};
    for (int i = 0; i < fast_count; i++) {
        fast[i] = unknowns[FIRST_FAST + i] * map->scale[i];
    }
    if (search->blocked) {
        double force = map->law.held.plant.total_mass * map->speed / map->period;
        law_change(&map->law, map->law.inputs.phase, unknowns[FIRST_FAST + fast_count] * force);
    }
    Moment moment = search->like;
    Visit visits[2];
    uint64_t itinerary;
    Budget budget = budget_of(map->period);
    moment_place(map, unknowns[VELOCITY] * map->speed, fast, search->psi, &moment);
    if (!map_periods(map, 0.0, 1, &moment, &budget, visits, &itinerary)) {
        return false;
    }
    change[VELOCITY] = (visits[1].at[SLOW_VELOCITY] - visits[0].at[SLOW_VELOCITY]) / map->speed;
    for (int i = 0; i < fast_count; i++) {
        int k = FAST_STATES + i;
        change[FIRST_FAST + i] = (visits[1].at[k] - visits[0].at[k]) / map->scale[i];
    }
    *travel = visits[1].at[SLOW_POSITION] - visits[0].at[SLOW_POSITION];
    if (search->blocked) {
        change[FIRST_FAST + fast_count] = *travel / (map->speed * map->period);
    }
    return true;
}

/* The derivatives of `change` by the unknowns. */
static bool differentiate(Search *search, const double unknowns[UNKNOWNS],
                          const double change[UNKNOWNS], double jacobian[UNKNOWNS][UNKNOWNS]) {
    for (int j = 0; j < search->count; j++) {
        double beside[UNKNOWNS], changed[UNKNOWNS], travel;
        memcpy(beside, unknowns, sizeof beside);
        beside[j] += BESIDE;
        if (!change_in_period(search, beside, changed, &travel)) {
            return false;
        }
        for (int i = 0; i < search->count; i++) {
            jacobian[i][j] = (changed[i] - change[i]) / BESIDE;
        }
    }
    return true;
}

/* Broyden's update: makes the Jacobian map `step` to what the change has changed by; `left` is what remains of it. */
static void update(double jacobian[UNKNOWNS][UNKNOWNS], const double step[UNKNOWNS],
                   const double left[UNKNOWNS], int count) {
    double square = 0.0;
    for (int j = 0; j < count; j++) {
        square += step[j] * step[j];
    }
    for (int i = 0; i < count && square > 0.0; i++) {
        for (int j = 0; j < count; j++) {
            jacobian[i][j] += left[i] * step[j] / square;
        }
    }
}

/* Newton's method with Broyden's updates. Return false where it does not converge. */
static bool solve(Search *search, double unknowns[UNKNOWNS],
                  double jacobian[UNKNOWNS][UNKNOWNS], double *travel) {
    double change[UNKNOWNS];
    if (!change_in_period(search, unknowns, change, travel) ||
        !differentiate(search, unknowns, change, jacobian)) {
        return false;
    }
    for (int iteration = 0; iteration < MAX_ITERATIONS; iteration++) {
        double step[UNKNOWNS], largest = 0.0;
        for (int i = 0; i < search->count; i++) {
            step[i] = -change[i];
        }
        if (!solve_linear(jacobian, step, search->count)) {
            return false;
        }
        for (int i = 0; i < search->count; i++) {
            largest = fmax(largest, fabs(step[i]));
        }
        double share = largest > MAX_CHANGE ? MAX_CHANGE / largest : 1.0;
        double left[UNKNOWNS];
        for (int i = 0; i < search->count; i++) {
            step[i] *= share;
            unknowns[i] += step[i];
            left[i] = (share - 1.0) * change[i];
        }
        if (!change_in_period(search, unknowns, change, travel)) {
            return false;
        }
        if (largest <= CONVERGED) {
            return true;
        }
        for (int i = 0; i < search->count; i++) {
            left[i] += change[i];
        }
        update(jacobian, step, left, search->count);
    }
    return false;
}

/* Whether the linear map of a period decays: its high powers do. */
static bool is_stable(double jacobian[UNKNOWNS][UNKNOWNS], int count) {
    double power[UNKNOWNS][UNKNOWNS], square[UNKNOWNS][UNKNOWNS];
    for (int i = 0; i < count; i++) {
        for (int j = 0; j < count; j++) {
            power[i][j] = jacobian[i][j] + (i == j ? 1.0 : 0.0);
        }
    }
    double largest = 0.0;
    for (int k = 0; k < SQUARINGS && largest < 1e100; k++) {
        largest = 0.0;
        for (int i = 0; i < count; i++) {
            for (int j = 0; j < count; j++) {
                square[i][j] = 0.0;
                for (int l = 0; l < count; l++) {
                    square[i][j] += power[i][l] * power[l][j];
                }
                largest = fmax(largest, fabs(square[i][j]));
            }
        }
        memcpy(power, square, sizeof power);
    }
    return largest < DECAYED;
}

/* A search from the steady vibration without friction on. */
static Search search_of(const PeriodMap *map, double psi, bool blocked,
                        double unknowns[UNKNOWNS]) {
    int count = FIRST_FAST + map->fast_count + (blocked ? 1 : 0);
    Search search = {.map = *map, .psi = psi, .blocked = blocked, .count = count};
    double w = map->law.held.plant.drive_frequency;
    Response swing = steady_swing(map->vibration.resonator, map->section, w);
    unknowns[FIRST_FAST] = swing.displacement / map->scale[0];
    unknowns[FIRST_FAST + 1] = swing.rate / map->scale[1];
    if (map->fast_count > 2) {
        unknowns[FIRST_FAST + 2] = 1.0;
    }
    return search;
}

/* Find the steady motion under the load of the map, at normal phase `psi` [rad] at the section, from a slow velocity [m/s] on;
 * `velocity` becomes its mean. Return false where none is found or where it is not stable. */
static bool find_steady(const PeriodMap *map, double psi, double *velocity) {
    double unknowns[UNKNOWNS] = {*velocity / map->speed}, jacobian[UNKNOWNS][UNKNOWNS], travel;
    Search search = search_of(map, psi, false, unknowns);
    if (!solve(&search, unknowns, jacobian, &travel) || !is_stable(jacobian, search.count)) {
        return false;
    }
    *velocity = travel / map->period;
    return true;
}

/* Find the motion without travel and the `load` [N] that it takes, likewise, from a load on. */
static bool find_blocked(const PeriodMap *map, double psi, double *load) {
    double unknowns[UNKNOWNS] = {0.0}, jacobian[UNKNOWNS][UNKNOWNS], travel;
    Search search = search_of(map, psi, true, unknowns);
    double force = map->law.held.plant.total_mass * map->speed / map->period;
    unknowns[FIRST_FAST + map->fast_count] = *load / force;
    if (!solve(&search, unknowns, jacobian, &travel)) {
        return false;
    }
    *load = unknowns[FIRST_FAST + map->fast_count] * force;
    return true;
}

/* The law of the full device under the same inputs. */
static bool full_law(const Law *law, Law *full) {
    Device device = law->device;
    Refusal refusal;
    device.fidelity = 2;
    if (!law_prepare(full, &device, &law->inputs, &refusal)) {
        return false;
    }
    full->bending = law->bending;
    return true;
}

/* By second order both belong to periodic motions of the full device, found from those of first order on. */
static Averaged second_order(const Law *law, double normal_lead) {
    Averaged prediction = averaged(law, normal_lead), exact = prediction;
    if (!prediction.valid) {
        return prediction;
    }
    Law full;
    PeriodMap map;
    int turns = turns_of_load(law);
    prediction.valid = false;
    if (turns == 0 || !full_law(law, &full) || !period_map_prepare(&map, &full, turns)) {
        return prediction;
    }
    double psi = within_turn(normal_lead + law->inputs.frequency_ratio * map.section);
    bool found = find_steady(&map, psi, &exact.steady_velocity) &&
                 find_blocked(&map, psi, &exact.blocking_force);
    return found ? exact : prediction;
}

/* The predictions in the order of `averaging_order`. */
static Averaged (*const PREDICTIONS[])(const Law *law, double normal_lead) = {averaged, second_order};

Averaged prediction_of(const Law *law, double normal_lead) {
    return PREDICTIONS[law->device.averaging_order - 1](law, normal_lead);
}
