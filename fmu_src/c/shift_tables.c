#include "shift_tables.h"

#include <math.h>

#include "state.h"

static const ShiftPoint *shifts_of(OrbitTables *tables, OrbitCurve *curve, int index);

static void combine(OrbitTables *tables, OrbitCurve *curve, int index) {
    ShiftPoint *point = &curve->shifts[index];
    double weight[SERIES_LEADS];
    orbit_series_weights(curve->lead, weight);
    *point = (ShiftPoint){.known = true, .measured = true};
    for (int i = 0; i < SERIES_LEADS; i++) {
        const ShiftPoint *made = shifts_of(tables, orbit_curve_in_series(tables, curve, i), index);
        point->measured = point->measured && made->measured;
        for (int shift = 0; shift < ORBIT_SHIFTS; shift++) {
            point->of[shift] += weight[i] * made->of[shift];
        }
    }
}

/* A point of shifts, measured where it is missing. */
static const ShiftPoint *shifts_of(OrbitTables *tables, OrbitCurve *curve, int index) {
    ShiftPoint *point = &curve->shifts[index];
    if (!point->known && curve->combined) {
        combine(tables, curve, index);
    } else if (!point->known) {
        SlowPhase slow = {.turns = curve->turns, .waves = curve->waves};
        const PeriodMap *map = orbit_map_of(tables, &curve->device, &slow);
        shift_point_make(point, map, curve->lead, curve->middle, curve->reach, index);
    }
    return point;
}

/* The place of a velocity between points: the one before, up to the last but one, and the share of the next,
 * within 0 and 1. */
typedef struct {
    int before;
    double share;
} Between;

static Between between(const OrbitCurve *curve, double place, double velocity) {
    if (place < 0.0) {
        place = velocity > curve->middle ? 0.0 : BASE_PANELS;
    }
    double at = place * ((double)SHIFT_POINTS / BASE_PANELS) - 0.5;
    int before = (int)fmin(fmax(at, 0.0), SHIFT_POINTS - 2.0);
    return (Between){before, fmin(fmax(at - before, 0.0), 1.0)};
}

static double mean_of(const ShiftPoint *before, const ShiftPoint *after, double share,
                      OrbitShift shift) {
    return before->of[shift] + share * (after->of[shift] - before->of[shift]);
}

bool orbit_shifts_at(OrbitTables *tables, OrbitCurve *curve, double velocity, double phase,
                     ShiftsThere *shifts) {
    double place = curve->found ? orbit_place(curve, velocity) : -1.0;
    *shifts = (ShiftsThere){0.0, 0.0, 0.0, 0.0, 0.0};
    if (place < 0.0) {
        return curve->found;
    }
    Between there = between(curve, place, velocity);
    const ShiftPoint *before = shifts_of(tables, curve, there.before);
    const ShiftPoint *after = shifts_of(tables, curve, there.before + 1);
    double parts = phase * LAG_PHASES, rest = parts - floor(parts);
    OrbitShift part = (OrbitShift)(SHIFT_LAG + (int)parts % LAG_PHASES);
    OrbitShift next = (OrbitShift)(SHIFT_LAG + ((int)parts + 1) % LAG_PHASES);
    double lag = mean_of(before, after, there.share, part);
    shifts->lag = lag + rest * (mean_of(before, after, there.share, next) - lag);
    shifts->of_turn = mean_of(before, after, there.share, SHIFT_OF_TURN);
    shifts->added_mass = mean_of(before, after, there.share, SHIFT_ADDED_MASS);
    shifts->swing = mean_of(before, after, there.share, SHIFT_SWING);
    double shown = mean_of(before, after, there.share, SHIFT_SHOWN);
    shifts->unsure =
        mean_of(before, after, there.share, SHIFT_UNSURE) * (fabs(shifts->lag) + fabs(shown));
    return before->measured && after->measured;
}

/* What is gained from the point `index` on up to a share of the way to the next, and how unsure that is. The section
 * changes in the middle, and with it what V is. */
static bool gained_after(OrbitTables *tables, OrbitCurve *curve, int index, double share,
                         double *gained, double *unsure) {
    const ShiftPoint *before = shifts_of(tables, curve, index);
    const ShiftPoint *after = shifts_of(tables, curve, index + 1);
    double start = before->of[SHIFT_GAINED], end = after->of[SHIFT_GAINED];
    double part = share * (start + 0.5 * share * (end - start)) * PI / SHIFT_POINTS;
    double shown = share * (after->of[SHIFT_SHOWN] - before->of[SHIFT_SHOWN]);
    shown = index + 1 == SHIFT_POINTS / 2 ? 0.0 : shown;
    *gained = part + shown;
    *unsure = 0.5 * (before->of[SHIFT_UNSURE] + after->of[SHIFT_UNSURE]) * (fabs(part) + fabs(shown));
    return before->measured && after->measured;
}

bool orbit_shift_gained(OrbitTables *tables, OrbitCurve *curve, double from, double to,
                        double *gained, double *unsure) {
    *gained = *unsure = 0.0;
    if (!curve->found || from == to) {
        return curve->found;
    }
    Between start = between(curve, orbit_place(curve, from), from);
    Between end = between(curve, orbit_place(curve, to), to);
    bool forward = start.before < end.before || (start.before == end.before && start.share < end.share);
    const Between *low = forward ? &start : &end, *high = forward ? &end : &start;
    if (low->before == high->before && low->share == high->share) {
        return true;
    }
    double part, doubt;
    for (int i = low->before; i <= high->before; i++) {
        if (!gained_after(tables, curve, i, i == high->before ? high->share : 1.0, &part, &doubt)) {
            return false;
        }
        *gained += part;
        *unsure += doubt;
    }
    gained_after(tables, curve, low->before, low->share, &part, &doubt);
    *gained = forward ? *gained - part : part - *gained;
    *unsure = fmax(*unsure - doubt, 0.0);
    return true;
}
