#include "orbit_curve.h"

#include <stddef.h>

#include "contact.h"
#include "elementary.h"
#include "orbit_drift.h"
#include "state.h"

/* Sum of the last coefficients up to which they are rounding, over the largest. */
#define NEGLIGIBLE_TERMS 1e-13

/* Velocity beyond grazing at which the orbit there is found, in fast velocities. */
#define BEYOND 4.0

/* Parts of a turn over which the mean of the way is taken, and where the peak of a vibration is looked
 * for. */
enum { WAY_PARTS = 8, PEAK_PARTS = 16, PEAK_REFINEMENTS = 3 };

/* Waves of the normal load in a turn up to which the samples follow them. */
#define MAX_PEAK_WAVES 8.0

/* The `sum` of what w1 adds to the way since the section [m] at the ends of the parts [s] of a period. */
typedef struct {
    const PeriodMap *map;
    const HeldOrbit *orbit;
    double part, first, sum;
} WaySum;

/* Place [m] of the pair's centre at a position, without what the drive moves it. */
static double centre_of(const PeriodMap *map, const State *state, double position, double theta) {
    const Plant *plant = &map->law.held.plant;
    return position + plant->mass_fraction * state->displacement +
           map->fast.pair_velocity / plant->drive_frequency * sin(theta);
}

static void add_way(void *observer, int index, const State *state, double position) {
    WaySum *way = observer;
    double since = (index + 1) * way->part;
    double theta = way->orbit->section.theta + way->map->law.held.plant.drive_frequency * since;
    double centre = centre_of(way->map, state, position, theta);
    way->sum += centre - way->first - way->orbit->velocity * since;
}

bool orbit_way(const PeriodMap *map, const HeldOrbit *orbit, double *way) {
    const Moment *section = &orbit->section;
    int parts = WAY_PARTS * map->turns;
    double first = centre_of(map, &section->state, section->position, section->theta);
    WaySum sums = {map, orbit, map->period / parts, first, 0.0};
    Trace trace = {sums.part, sums.part, parts - 1, 0, add_way, &sums};
    Moment end;
    if (!orbit_trace(map, orbit->lead, -orbit->friction, section, (parts - 1) * sums.part, &trace, &end)) {
        return false;
    }
    *way = -sums.sum / parts;
    return true;
}

OrbitPoint orbit_section_point(const PeriodMap *map, const HeldOrbit *orbit) {
    const State *state = &orbit->section.state;
    OrbitPoint point = {.direction = orbit->direction, .found = true};
    point.of[ORBIT_FRICTION] = orbit->friction;
    point.of[ORBIT_FACTOR] = orbit->factor;
    point.of[ORBIT_OFFSET] = held_orbit_offset(map, orbit, &orbit->section);
    point.of[ORBIT_DISPLACEMENT] = state->displacement;
    point.of[ORBIT_RATE] = state->rate;
    point.of[ORBIT_BRISTLE] = orbit->section.bristle;
    point.beyond = orbit->reversals == 0.0 && !orbit->sticks;
    return point;
}

bool orbit_point_of(const PeriodMap *map, const HeldOrbit *orbit, OrbitPoint *point) {
    *point = orbit_section_point(map, orbit);
    return orbit_way(map, orbit, &point->of[ORBIT_WAY]);
}

/* Velocity [m/s] of the slider against `direction` less the mean one. */
static double against(const HeldOrbit *orbit, const State *state) {
    return orbit->direction * (orbit->velocity - state->velocity);
}

/* The same `angle` [rad] after a moment of the orbit; `there` is the moment then. */
static double vibration_after(const PeriodMap *map, const HeldOrbit *orbit, const Moment *moment,
                              double angle, Moment *there) {
    double duration = angle / map->law.held.plant.drive_frequency;
    *there = *moment;
    if (duration > 0.0 &&
        !orbit_advance(map, orbit->lead, -orbit->friction, moment, duration, there)) {
        return NAN;
    }
    return against(orbit, &there->state);
}

/* The sample that is the largest, and its index. */
typedef struct {
    const HeldOrbit *orbit;
    double size;
    int index;
} LargestSample;

static void keep_largest(void *observer, int index, const State *state, double position) {
    LargestSample *largest = observer;
    double size = against(largest->orbit, state);
    (void)position;
    if (size > largest->size) {
        largest->size = size;
        largest->index = index;
    }
}

/* Peak [m/s] of the vibration against the direction of sliding, which it takes off from V: the largest of
 * samples, by parabolas through three points around it. */
static double grazing_peak(const PeriodMap *map, const HeldOrbit *orbit) {
    double waves = fmin(fabs(map->law.inputs.frequency_ratio), MAX_PEAK_WAVES);
    int parts = PEAK_PARTS * map->turns * (1 + (int)waves);
    double part = TAU * map->turns / parts, time = map->period / parts;
    LargestSample largest = {orbit, -INFINITY, 0};
    Trace trace = {time, time, parts, 0, keep_largest, &largest};
    Moment base, next;
    if (!orbit_trace(map, orbit->lead, -orbit->friction, &orbit->section, map->period, &trace, &next)) {
        return NAN;
    }
    vibration_after(map, orbit, &orbit->section, part * largest.index, &base);
    double place = part, best = largest.size;
    for (int i = 0; i < PEAK_REFINEMENTS; i++, part *= 0.1) {
        double behind = vibration_after(map, orbit, &base, place - part, &next);
        double ahead = vibration_after(map, orbit, &base, place + part, &next);
        double bend = behind - 2.0 * best + ahead;
        double shift = bend < 0.0 ? 0.5 * part * (behind - ahead) / bend : 0.0;
        double moved = fmax(place + fmin(fmax(shift, -0.5 * part), 0.5 * part), 0.0);
        double there = vibration_after(map, orbit, &base, moved, &next);
        if (there > best) {
            best = there;
            place = moved;
        }
    }
    return best;
}

static bool begin_beyond(OrbitCurve *curve, const PeriodMap *map, int direction, double *grazing) {
    HeldOrbit orbit;
    double velocity = BEYOND * direction * map->speed;
    if (held_orbit_at(map, curve->lead, velocity, NULL, &orbit) != ORBIT_FOUND ||
        !orbit_point_of(map, &orbit, &curve->beyond[direction > 0])) {
        return false;
    }
    *grazing = direction * grazing_peak(map, &orbit);
    return isfinite(*grazing);
}

void orbit_curve_begin(OrbitCurve *curve, const PeriodMap *map, double lead) {
    double low = 0.0, high = 0.0;
    curve->lead = lead;
    curve->next = 0;
    curve->ride = 0;
    for (int i = 0; i < CURVE_PANELS; i++) {
        curve->panel[i].known = false;
    }
    curve->found = begin_beyond(curve, map, FORWARD, &high) &&
                   begin_beyond(curve, map, BACKWARD, &low) && low < high;
    curve->middle = 0.5 * (low + high);
    curve->reach = 0.5 * (high - low);
}

/* Clenshaw's recurrences for the even and the odd polynomials, T_2j(x) = T_j(y) and
 * T_2j+1(x) = x (U_j(y) - U_j-1(y)) with y = T_2(x): the two run side by side. */
double orbit_panel_at(const OrbitPanel *panel, OrbitQuantity quantity, double place) {
    const double *c = panel->coefficient[quantity];
    double x = 2.0 * (place * panel->parts - panel->index) - 1.0, y = 2.0 * x * x - 1.0;
    double even = 0.0, even_behind = 0.0, odd = 0.0, odd_behind = 0.0;
    for (int k = panel->terms[quantity] - 2; k > 0; k -= 2) {
        double next = 2.0 * y * even + (c[k] - even_behind);
        even_behind = even;
        even = next;
        next = 2.0 * y * odd + (c[k + 1] - odd_behind);
        odd_behind = odd;
        odd = next;
    }
    double last_odd = 2.0 * y * odd + (c[1] - odd_behind);
    return y * even + (c[0] - even_behind) + x * (last_odd - odd);
}

void orbit_panel_begin(OrbitPanel *panel, int depth, int index) {
    *panel = (OrbitPanel){.known = true, .depth = depth, .index = index, .parts = 1 << depth};
    panel->direction = index >> depth < BASE_PANELS / 2 ? FORWARD : BACKWARD;
}

void orbit_panel_end(OrbitPanel *panel) {
    for (int q = 0; q < ORBIT_QUANTITIES; q++) {
        const double *c = panel->coefficient[q];
        double largest = 0.0, rest = 0.0;
        for (int k = 0; k < ORBIT_NODES; k++) {
            largest = fmax(largest, fabs(c[k]));
        }
        panel->terms[q] = ORBIT_NODES;
        while (panel->terms[q] > 1 && rest <= NEGLIGIBLE_TERMS * largest) {
            rest += fabs(c[--panel->terms[q]]);
        }
        panel->terms[q] += rest > NEGLIGIBLE_TERMS * largest;
        panel->terms[q] += panel->terms[q] % 2;
    }
}
