#include "orbit_tables.h"

#include <stddef.h>
#include <string.h>

#include "contact.h"
#include "elementary.h"
#include "orbit_nodes.h"
#include "state.h"

static bool same_device(const Device *a, const Device *b) {
    return a->slider_mass == b->slider_mass && a->resonator_mass == b->resonator_mass &&
           a->resonator_frequency == b->resonator_frequency &&
           a->damping_ratio == b->damping_ratio && a->normal_preload == b->normal_preload &&
           a->normal_amplitude == b->normal_amplitude && a->base_amplitude == b->base_amplitude &&
           a->drive_frequency == b->drive_frequency && a->tangential_force == b->tangential_force &&
           a->friction_coefficient == b->friction_coefficient &&
           a->friction_faces == b->friction_faces && a->friction_law == b->friction_law &&
           a->bristle_stiffness == b->bristle_stiffness &&
           a->bristle_damping == b->bristle_damping && a->tolerance == b->tolerance;
}

const PeriodMap *orbit_map_of(OrbitTables *tables, const Device *device, const SlowPhase *slow) {
    PeriodMap *map = &tables->map;
    if (!tables->mapped || map->turns != slow->turns ||
        map->law.inputs.frequency_ratio != slow->waves || !same_device(&tables->device, device)) {
        Refusal refusal;
        tables->mapped = period_map_prepare(map, device, slow->waves, slow->turns, &refusal);
        map->law.bending = tables->bending;
        tables->device = *device;
    }
    return tables->mapped ? map : NULL;
}

/* The slot of a curve that is kept, or the one used longest ago. */
static OrbitCurve *slot_of(OrbitTables *tables, const Device *device, const SlowPhase *slow,
                           double lead, bool combined) {
    OrbitCurve *oldest = &tables->curve[0];
    for (int i = 0; i < CURVES; i++) {
        OrbitCurve *curve = &tables->curve[i];
        if (curve->known && curve->combined == combined && curve->lead == lead &&
            curve->waves == slow->waves && curve->turns == slow->turns &&
            same_device(&curve->device, device)) {
            return curve;
        }
        if (!curve->known || (oldest->known && curve->used < oldest->used)) {
            oldest = curve;
        }
    }
    oldest->known = false;
    return oldest;
}

static double lead_in_series(int index) {
    return TAU * index / SERIES_LEADS;
}

/* Weights of the leads of the series at one lead: the trigonometric cardinal functions, cosines by
 * Chebyshev's recurrence. */
void orbit_series_weights(double lead, double weight[SERIES_LEADS]) {
    for (int i = 0; i < SERIES_LEADS; i++) {
        double cosine = cos(lead - lead_in_series(i)), before = 1.0, now = cosine;
        double sum = 0.5;
        for (int k = 1; k <= SERIES_LEADS / 2; k++) {
            sum += now;
            double next = 2.0 * cosine * now - before;
            before = now;
            now = next;
        }
        weight[i] = 2.0 * sum / SERIES_LEADS;
    }
}

static SlowPhase phase_of(const OrbitCurve *curve) {
    return (SlowPhase){.turns = curve->turns, .waves = curve->waves};
}

OrbitCurve *orbit_curve_in_series(OrbitTables *tables, const OrbitCurve *curve, int index) {
    SlowPhase slow = phase_of(curve);
    return orbit_curve_of(tables, &curve->device, &slow, lead_in_series(index), false);
}

static void add_point(OrbitPoint *sum, double weight, const OrbitPoint *point) {
    for (int q = 0; q < ORBIT_QUANTITIES; q++) {
        sum->of[q] += weight * point->of[q];
    }
    sum->direction = point->direction;
    sum->found = true;
    sum->beyond = point->beyond;
}

static void combine_begin(OrbitTables *tables, OrbitCurve *curve) {
    double weight[SERIES_LEADS];
    orbit_series_weights(curve->lead, weight);
    curve->found = true;
    curve->middle = curve->reach = 0.0;
    curve->next = 0;
    curve->ride = 0;
    curve->beyond[0] = curve->beyond[1] = (OrbitPoint){.direction = 0};
    for (int i = 0; i < CURVE_PANELS; i++) {
        curve->panel[i].known = false;
    }
    for (int i = 0; i < SERIES_LEADS; i++) {
        const OrbitCurve *part = orbit_curve_in_series(tables, curve, i);
        curve->found = curve->found && part->found;
        curve->middle += weight[i] * part->middle;
        curve->reach += weight[i] * part->reach;
        add_point(&curve->beyond[0], weight[i], &part->beyond[0]);
        add_point(&curve->beyond[1], weight[i], &part->beyond[1]);
    }
}

static const OrbitPanel *panel_of(OrbitTables *tables, OrbitCurve *curve, int depth, int index);

/* The combination of a panel of all curves of the series. It is rough where one of them is. */
static void combine_panel(OrbitTables *tables, OrbitCurve *curve, OrbitPanel *panel) {
    double weight[SERIES_LEADS];
    orbit_series_weights(curve->lead, weight);
    panel->found = panel->holds = true;
    for (int i = 0; i < SERIES_LEADS; i++) {
        OrbitCurve *part = orbit_curve_in_series(tables, curve, i);
        const OrbitPanel *made = panel_of(tables, part, panel->depth, panel->index);
        panel->maps += made->maps;
        panel->found = panel->found && made->found;
        panel->holds = panel->holds && made->holds;
        if (!panel->found) {
            continue;
        }
        for (int q = 0; q < ORBIT_QUANTITIES; q++) {
            for (int k = 0; k < ORBIT_NODES; k++) {
                panel->coefficient[q][k] += weight[i] * made->coefficient[q][k];
            }
        }
    }
    orbit_panel_end(panel);
}

/* A panel of a curve, made where it is missing. */
static const OrbitPanel *panel_of(OrbitTables *tables, OrbitCurve *curve, int depth, int index) {
    for (int i = 0; i < CURVE_PANELS && curve->panel[i].known; i++) {
        const OrbitPanel *panel = &curve->panel[i];
        if (panel->index == index && panel->depth == depth) {
            return panel;
        }
    }
    OrbitPanel *panel = &curve->panel[curve->next];
    curve->recent = NULL;
    curve->next = (curve->next + 1) % CURVE_PANELS;
    orbit_panel_begin(panel, depth, index);
    if (curve->combined) {
        combine_panel(tables, curve, panel);
    } else {
        SlowPhase slow = phase_of(curve);
        orbit_panel_make(panel, curve, orbit_map_of(tables, &curve->device, &slow));
    }
    return panel;
}

static int index_at(double place, int depth) {
    int index = (int)(place * (1 << depth)), last = (BASE_PANELS << depth) - 1;
    return index < last ? index : last;
}

OrbitCurve *orbit_curve_of(OrbitTables *tables, const Device *device, const SlowPhase *slow,
                           double lead, bool combined) {
    OrbitCurve *curve = slot_of(tables, device, slow, lead, combined);
    curve->used = ++tables->clock;
    if (curve->known) {
        return curve;
    }
    curve->known = true;
    curve->combined = combined;
    curve->device = *device;
    curve->waves = slow->waves;
    curve->turns = slow->turns;
    curve->lead = lead;
    for (int i = 0; i < SHIFT_POINTS; i++) {
        curve->shifts[i].known = false;
    }
    if (combined) {
        combine_begin(tables, curve);
    } else {
        const PeriodMap *map = orbit_map_of(tables, device, slow);
        curve->found = map != NULL;
        if (map != NULL) {
            orbit_curve_begin(curve, map, lead);
        }
    }
    return curve;
}

/* A panel of a curve that a ride asks for. */
static const OrbitPanel *ask(OrbitTables *tables, OrbitCurve *curve, int depth, int index) {
    const OrbitPanel *panel = panel_of(tables, curve, depth, index);
    int place = BASE_PANELS * ((1 << depth) - 1) + index;
    unsigned char bit = (unsigned char)(1u << place % 8);
    if (curve->ride != tables->ride) {
        curve->ride = tables->ride;
        curve->recent = NULL;
        memset(curve->asked, 0, sizeof curve->asked);
    }
    if (!(curve->asked[place / 8] & bit)) {
        curve->asked[place / 8] |= bit;
        tables->maps += panel->maps;
    }
    return panel;
}

/* The panel around a place that holds and has all orbits, made where it is missing; NULL where there is
 * none. */
static const OrbitPanel *panel_around(OrbitTables *tables, OrbitCurve *curve, double place) {
    int deepest = curve->combined ? SERIES_DEPTH : MAX_DEPTH;
    const OrbitPanel *recent = curve->ride == tables->ride ? curve->recent : NULL;
    if (recent != NULL && recent->index == index_at(place, recent->depth)) {
        return recent;
    }
    for (int depth = 0; depth <= deepest; depth++) {
        const OrbitPanel *panel = ask(tables, curve, depth, index_at(place, depth));
        if (panel->holds) {
            curve->recent = panel->found ? panel : NULL;
            return curve->recent;
        }
    }
    return NULL;
}

/* Place among the base panels, from 0 on; negative beyond grazing. */
static double place_between(double middle, double reach, double velocity) {
    double share = (velocity - middle) / reach;
    return fabs(share) < 1.0 ? acos(share) / PI * BASE_PANELS : -1.0;
}

double orbit_place(const OrbitCurve *curve, double velocity) {
    return place_between(curve->middle, curve->reach, velocity);
}

static const OrbitPoint *point_beyond(const OrbitCurve *curve, double velocity) {
    return &curve->beyond[velocity > curve->middle];
}

bool orbit_point_at(OrbitTables *tables, OrbitCurve *curve, double velocity, OrbitPoint *point) {
    if (!curve->found) {
        return false;
    }
    double place = orbit_place(curve, velocity);
    if (place < 0.0) {
        *point = *point_beyond(curve, velocity);
        return true;
    }
    const OrbitPanel *panel = panel_around(tables, curve, place);
    if (panel == NULL) {
        return false;
    }
    for (int q = 0; q < ORBIT_QUANTITIES; q++) {
        point->of[q] = orbit_panel_at(panel, (OrbitQuantity)q, place);
    }
    point->direction = panel->direction;
    point->found = true;
    point->beyond = false;
    return true;
}

bool orbit_friction_at(OrbitTables *tables, OrbitCurve *curve, double velocity, double *friction,
                       double *factor) {
    if (!curve->found) {
        return false;
    }
    double place = orbit_place(curve, velocity);
    if (place < 0.0) {
        const OrbitPoint *beyond = point_beyond(curve, velocity);
        *friction = beyond->of[ORBIT_FRICTION];
        *factor = beyond->of[ORBIT_FACTOR];
        return true;
    }
    const OrbitPanel *panel = panel_around(tables, curve, place);
    if (panel == NULL) {
        return false;
    }
    *friction = orbit_panel_at(panel, ORBIT_FRICTION, place);
    *factor = orbit_panel_at(panel, ORBIT_FACTOR, place);
    return true;
}

OrbitSeries orbit_series_of(OrbitTables *tables, const Device *device, const SlowPhase *slow) {
    OrbitSeries series;
    for (int i = 0; i < SERIES_LEADS; i++) {
        series.part[i] = orbit_curve_of(tables, device, slow, lead_in_series(i), false);
    }
    return series;
}

bool orbit_series_found(const OrbitSeries *series) {
    for (int i = 0; i < SERIES_LEADS; i++) {
        if (!series->part[i]->found) {
            return false;
        }
    }
    return true;
}

/* The panels of all curves around a place, of the depth at which all hold; false where there is none, or an
 * orbit is missing. */
static bool series_panels(OrbitTables *tables, const OrbitSeries *series, double place,
                          const OrbitPanel *panels[SERIES_LEADS]) {
    bool holds = false, found = false;
    for (int depth = 0; depth <= SERIES_DEPTH && !holds; depth++) {
        int index = index_at(place, depth);
        holds = found = true;
        for (int i = 0; i < SERIES_LEADS; i++) {
            panels[i] = ask(tables, series->part[i], depth, index);
            holds = holds && panels[i]->holds;
            found = found && panels[i]->found;
        }
    }
    return holds && found;
}

/* Sums the first `count` quantities at a lead and a velocity. */
static bool series_sum(OrbitTables *tables, const OrbitSeries *series, double lead, double velocity,
                       int count, OrbitPoint *point) {
    double weight[SERIES_LEADS];
    OrbitCurve *const *part = series->part;
    const OrbitPanel *panels[SERIES_LEADS];
    double middle = 0.0, reach = 0.0;
    orbit_series_weights(lead, weight);
    *point = (OrbitPoint){.direction = 0};
    for (int i = 0; i < SERIES_LEADS; i++) {
        if (!part[i]->found) {
            return false;
        }
        middle += weight[i] * part[i]->middle;
        reach += weight[i] * part[i]->reach;
    }
    double place = place_between(middle, reach, velocity);
    if (place < 0.0) {
        for (int i = 0; i < SERIES_LEADS; i++) {
            add_point(point, weight[i], &part[i]->beyond[velocity > middle]);
        }
        return true;
    }
    if (!series_panels(tables, series, place, panels)) {
        return false;
    }
    for (int i = 0; i < SERIES_LEADS; i++) {
        for (int q = 0; q < count; q++) {
            point->of[q] += weight[i] * orbit_panel_at(panels[i], (OrbitQuantity)q, place);
        }
    }
    point->direction = panels[0]->direction;
    point->found = true;
    return true;
}

bool orbit_series_at(OrbitTables *tables, const OrbitSeries *series, double lead, double velocity,
                     OrbitPoint *point) {
    return series_sum(tables, series, lead, velocity, ORBIT_QUANTITIES, point);
}

bool orbit_series_friction_at(OrbitTables *tables, const OrbitSeries *series, double lead,
                              double velocity, double *friction, double *factor) {
    OrbitPoint point;
    bool found = series_sum(tables, series, lead, velocity, ORBIT_FACTOR + 1, &point);
    *friction = point.of[ORBIT_FRICTION];
    *factor = point.of[ORBIT_FACTOR];
    return found;
}
