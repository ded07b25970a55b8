#include "prediction.h"

#include <string.h>

#include "../base/linear_system.h"
#include "period_map.h"

/* Change of an unknown by which derivatives are taken. */
#define BESIDE 1e-6

/* Largest change of an unknown in an iteration, and the change at which the iteration ends: the derivatives err by about
 * BESIDE, so that the next change would be rounding. Number of iterations. */
#define MAX_CHANGE 0.2
#define CONVERGED 1e-7
enum { MAX_ITERATIONS = 24 };

/* Periods by which the start of a search is followed where friction may change V by more than an iteration: it brings
 * near what is looked for. */
enum { LEAD_IN = 2 };

/* Share of the work of a step that a search may take: a host that reads an output does not expect to wait. */
#define SHARE_OF_STEP 0.1

/* Squarings of the linear map after which it must have decayed: in 2^24 periods, more than rounding of its derivatives
 * could make it. */
enum { SQUARINGS = 24 };
#define DECAYED 0.5

/* A periodic motion that is looked for. Unknowns are the slow velocity, the fast states and, for motion that is
 * blocked, the load; `change` is what a period changes them by, in place of the load the position. */
typedef struct {
    PeriodMap map;
    Budget budget;                             /* of all the maps of the search */
    double psi;                                /* normal phase at the section [rad] */
    bool blocked;                              /* whether it must not travel, under a load that is looked for */
    int count;                                 /* number of unknowns */
    double scale[UNKNOWNS], unknown[UNKNOWNS]; /* scales, and unknowns over them */
    double change[UNKNOWNS];                   /* in a period, over the scales */
    double travel, reversals;                  /* displacement [m] and number of reversals in a period */
    double jacobian[UNKNOWNS][UNKNOWNS];
} Search;

/* What a period changes from `unknown` on. Return false where there is no motion. */
static bool change_in_period(Search *search, const double unknown[UNKNOWNS], double change[UNKNOWNS]) {
    PeriodMap *map = &search->map;
    int states = 1 + map->fast_count;
    double at[UNKNOWNS] = {0.0}, fast[MAX_FAST] = {0.0};
    for (int i = 0; i < search->count; i++) {
        at[i] = unknown[i] * search->scale[i];
    }
    if (search->blocked) {
        system_change(&map->system, map->system.inputs.phase, at[states]);
    }
    memcpy(fast, at + 1, (size_t)map->fast_count * sizeof fast[0]);
    Moment moment = {.mode = STICK};
    SectionState sections[2];
    uint64_t itinerary;
    moment_place(map, at[0], fast, search->psi, &moment);
    if (!map_periods(map, 0.0, 1, &moment, &search->budget, sections, &itinerary)) {
        return false;
    }
    for (int i = 0; i < states; i++) {
        change[i] = (sections[1].at[i] - sections[0].at[i]) / search->scale[i];
    }
    search->travel = sections[1].at[SLOW_POSITION] - sections[0].at[SLOW_POSITION];
    search->reversals = sections[1].at[REVERSALS] - sections[0].at[REVERSALS];
    if (search->blocked) {
        change[states] = search->travel / (map->speed * map->period);
    }
    return true;
}

/* The derivatives of `change` by the unknowns. */
static bool differentiate(Search *search) {
    for (int j = 0; j < search->count; j++) {
        double beside[UNKNOWNS], changed[UNKNOWNS];
        memcpy(beside, search->unknown, sizeof beside);
        beside[j] += BESIDE;
        if (!change_in_period(search, beside, changed)) {
            return false;
        }
        for (int i = 0; i < search->count; i++) {
            search->jacobian[i][j] = (changed[i] - search->change[i]) / BESIDE;
        }
    }
    return true;
}

/* Follow the motion for some periods under strong friction, without its travel where it is blocked. */
static bool lead_in(Search *search) {
    int states = 1 + search->map.fast_count;
    for (int k = 0; k < LEAD_IN && search->map.share > MAX_CHANGE; k++) {
        if (!change_in_period(search, search->unknown, search->change)) {
            return false;
        }
        for (int i = 0; i < states; i++) {
            search->unknown[i] += search->change[i];
        }
        search->unknown[0] -= search->blocked ? search->change[states] : 0.0;
    }
    return change_in_period(search, search->unknown, search->change);
}

/* Newton's method. Return false where it does not converge. */
static bool solve(Search *search) {
    bool moves = lead_in(search);
    for (int iteration = 0; moves && iteration < MAX_ITERATIONS; iteration++) {
        double step[UNKNOWNS], largest = 0.0;
        for (int i = 0; i < search->count; i++) {
            step[i] = -search->change[i];
        }
        if (!differentiate(search) || !solve_linear(search->jacobian, step, search->count)) {
            return false;
        }
        for (int i = 0; i < search->count; i++) {
            largest = fmax(largest, fabs(step[i]));
        }
        double share = largest > MAX_CHANGE ? MAX_CHANGE / largest : 1.0;
        for (int i = 0; i < search->count; i++) {
            search->unknown[i] += share * step[i];
        }
        moves = change_in_period(search, search->unknown, search->change);
        if (moves && largest <= CONVERGED) {
            return true;
        }
    }
    return false;
}

/* Whether the linear map of a period decays: its high powers do. */
static bool is_stable(const Search *search) {
    double power[UNKNOWNS][UNKNOWNS], square[UNKNOWNS][UNKNOWNS], largest = 0.0;
    memcpy(power, search->jacobian, sizeof power);
    for (int i = 0; i < search->count; i++) {
        power[i][i] += 1.0;
    }
    for (int k = 0; k < SQUARINGS && largest < 1e100; k++) {
        largest = 0.0;
        for (int i = 0; i < search->count; i++) {
            for (int j = 0; j < search->count; j++) {
                square[i][j] = 0.0;
                for (int l = 0; l < search->count; l++) {
                    square[i][j] += power[i][l] * power[l][j];
                }
                largest = fmax(largest, fabs(square[i][j]));
            }
        }
        memcpy(power, square, sizeof power);
    }
    return largest < DECAYED;
}

/* A search at normal phase `psi` [rad], from a slow velocity [m/s] and a load [N] on, with fast states of the steady
 * vibration without friction. The scale of loads is the force that stops v_q in a period. */
static Search search_of(const PeriodMap *map, double psi, bool blocked, double velocity, double load) {
    const Plant *plant = &map->system.plant;
    int states = 1 + map->fast_count;
    Search search = {.map = *map, .psi = psi, .blocked = blocked, .count = states + blocked};
    search.budget = budget_of(map->period);
    search.budget.spent = 1.0 - SHARE_OF_STEP;
    Response swing = steady_swing(map->system.fast.resonator, map->section, plant->drive_frequency);
    const double fast[MAX_FAST] = {swing.displacement, swing.rate, map->scale[2]};
    search.scale[0] = map->speed;
    search.unknown[0] = velocity / map->speed;
    for (int i = 0; i < map->fast_count; i++) {
        search.scale[1 + i] = map->scale[i];
        search.unknown[1 + i] = fast[i] / map->scale[i];
    }
    search.scale[states] = plant->total_mass * map->speed / map->period;
    search.unknown[states] = load / search.scale[states];
    return search;
}

/* The system of the full device under the same inputs. A resonator without mass moves nothing: critical damping at the
 * drive frequency lets its own motion decay within a period, so that the search need not wait for it. */
static bool full_system(const System *system, System *full) {
    Device device = system->device;
    Refusal refusal;
    device.fidelity = 2;
    if (device.resonator_mass == 0.0) {
        device.resonator_frequency = device.drive_frequency;
        device.damping_ratio = 1.0;
    }
    if (!system_prepare(full, &device, &system->inputs, &refusal)) {
        return false;
    }
    full->bending = system->bending;
    return true;
}

/* Find the periodic motion that a quantity belongs to, at normal phase `psi` [rad] at the section, from averages on,
 * which must hold the load: the stable motion under the load of the map, or the motion without travel and the load that
 * it takes. One that never reverses is none: the slider sticks, under other loads, too. Return false, with `exact`
 * undefined, where there is none. */
static bool find(const PeriodMap *map, double psi, Quantity quantity, const Prediction *start, Prediction *exact) {
    bool blocked = quantity == BLOCKING_FORCE;
    Search search = search_of(map, psi, blocked, blocked ? 0.0 : start->value, blocked ? start->value : 0.0);
    int last = search.count - 1;
    if (!start->holds || !solve(&search)) {
        return false;
    }
    *exact = (Prediction){search.travel / map->period, true, true};
    if (blocked) {
        exact->value = search.unknown[last] * search.scale[last];
        return search.reversals > 0.0;
    }
    return is_stable(&search);
}

/* By second order it belongs to a periodic motion of the full device. The search begins at averages of first order.
 * Where bristles damp less than they hold, one velocity alone balances a load: the balance of Coulomb friction is then
 * a good and cheap guess. */
static Prediction second_order(const System *system, double normal_lead, Quantity quantity) {
    System full;
    PeriodMap map;
    Prediction start, exact;
    int turns = turns_of_period(system, MAX_TURNS_OF_LOAD, 0.0);
    bool repeats = full_system(system, &full) && period_map_prepare(&map, &full, turns);
    double psi = repeats ? within_turn(normal_lead + system->inputs.frequency_ratio * map.section) : 0.0;
    double damping = damping_share(&system->bristle, system->fast.velocity, system->device.drive_frequency);
    if (repeats && is_elastic(&system->bristle) && damping <= 1.0) {
        System coulomb = *system;
        coulomb.bristle = (Bristle){system->bristle.coefficient, INFINITY, 0.0};
        start = first_order_prediction(&coulomb, normal_lead, quantity);
        if (find(&map, psi, quantity, &start, &exact)) {
            return exact;
        }
    }
    start = first_order_prediction(system, normal_lead, quantity);
    if (repeats && find(&map, psi, quantity, &start, &exact)) {
        return exact;
    }
    start.valid = false;
    return start;
}

Prediction prediction_of(const System *system, double normal_lead, Quantity quantity) {
    return system->device.averaging_order == 1 ? first_order_prediction(system, normal_lead, quantity)
                                               : second_order(system, normal_lead, quantity);
}
