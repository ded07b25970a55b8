#include "orbit_price.h"

#include "orbit_ride.h"
#include "state.h"

/* Turns of the orbit whose resolved motion costs what a curve at one lead, the series over leads and the
 * searches after a change do: instructions counted with table 1, under Coulomb and LuGre friction. */
#define CURVE_TURNS 400.0
#define SERIES_TURNS 4300.0
#define SEARCH_TURNS 160.0
#define BRISTLE_CURVE_TURNS 450.0
#define BRISTLE_SERIES_TURNS 4600.0
#define BRISTLE_SEARCH_TURNS 600.0

/* What rounding takes from a price that has been waited for. */
#define ROUNDING 1e-9

void orbit_visit(VisitedLeads *leads, double lead) {
    for (int i = 0; i < leads->count && i < MAX_LEADS; i++) {
        if (leads->lead[i] == lead) {
            return;
        }
    }
    if (leads->count < MAX_LEADS) {
        leads->lead[leads->count] = lead;
    }
    leads->count += leads->count <= MAX_LEADS;
}

static OrbitSource source_at(const Law *law, const OrbitState *orbit, double lead,
                             const SlowPhase *slow) {
    OrbitState visiting = *orbit;
    orbit_visit(&visiting.leads, lead);
    return orbit_source_of(&visiting, &law->device, slow_phase_drifts(slow));
}

static bool has_curve(const PaidTables *paid, double waves, double lead) {
    for (int i = 0; i < paid->count; i++) {
        if (paid->waves[i] == waves && paid->lead[i] == lead) {
            return true;
        }
    }
    return false;
}

bool orbit_has_series(const PaidTables *paid, double waves) {
    return paid->has_series != 0 && paid->series_waves == waves;
}

double orbit_price(const Law *law, const OrbitState *orbit, double lead, bool changed) {
    const PaidTables *paid = &orbit->paid;
    const SlowPhase slow = orbit_phase_of(law);
    bool coulomb = law->device.friction_law == 0;
    double turns = 0.0;
    switch (source_at(law, orbit, lead, &slow)) {
    case FROM_CURVE:
        if (!has_curve(paid, slow.waves, lead)) {
            turns = coulomb ? CURVE_TURNS : BRISTLE_CURVE_TURNS;
        }
        break;
    case FROM_COMBINED:
        changed = true;
        /* fall through */
    case FROM_SERIES:
        if (changed && !orbit_has_series(paid, slow.waves)) {
            turns = coulomb ? SERIES_TURNS : BRISTLE_SERIES_TURNS;
        }
        break;
    case FROM_SEARCH:
        if (changed) {
            turns = coulomb ? SEARCH_TURNS : BRISTLE_SEARCH_TURNS;
        }
        break;
    }
    return TAU * slow.turns * turns;
}

bool orbit_is_due(const Law *law, const OrbitState *orbit) {
    const SlowPhase slow = orbit_phase_of(law);
    double price = law->device.friction_law == 0 ? SERIES_TURNS : BRISTLE_SERIES_TURNS;
    return !slow_phase_drifts(&slow) ||
           orbit->waited >= TAU * slow.turns * price * (1.0 - ROUNDING);
}

/* Note a curve. Where more come than the cache has places for beside the series, that may be gone. */
static void add_curve(PaidTables *paid, double waves, double lead) {
    if (has_curve(paid, waves, lead)) {
        return;
    }
    if (paid->count == MAX_LEADS) {
        for (int i = 1; i < MAX_LEADS; i++) {
            paid->waves[i - 1] = paid->waves[i];
            paid->lead[i - 1] = paid->lead[i];
        }
        paid->count--;
        paid->has_series = 0;
    }
    paid->waves[paid->count] = waves;
    paid->lead[paid->count] = lead;
    paid->count++;
}

void orbit_pay(const Law *law, OrbitState *orbit, double lead) {
    PaidTables *paid = &orbit->paid;
    const SlowPhase slow = orbit_phase_of(law);
    switch (source_at(law, orbit, lead, &slow)) {
    case FROM_CURVE:
        add_curve(paid, slow.waves, lead);
        break;
    case FROM_COMBINED:
    case FROM_SERIES:
        if (!orbit_has_series(paid, slow.waves)) {
            *paid = (PaidTables){.has_series = 1, .series_waves = slow.waves};
        }
        break;
    case FROM_SEARCH:
        break;
    }
}
