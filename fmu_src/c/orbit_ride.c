#include "orbit_ride.h"

#include <stddef.h>

#include "constants.h"
#include "contact.h"
#include "elementary.h"
#include "orbit_newton.h"
#include "orbit_price.h"
#include "state.h"

/* Rates of the motion over the drive frequency up to which a turn of the drive is resolved often enough to
 * find orbits. */
#define MAX_RATE 300.0

/* How far from the fast velocity grazing counts as unknown where there is no curve, as a share of it. */
#define GRAZING_BAND 0.05

/* Turns for which motion is resolved where there is no orbit, until one is looked for again. */
#define MISSED_TURNS 100.0

/* Period maps for searches up to which a step has them, however short it is, and further ones for each turn of
 * the drive in it: where they take more, motion is resolved. */
#define SEARCH_MAPS 300.0
#define SEARCH_MAPS_IN_TURN 20.0

/* Waves of the normal load in a turn of the drive up to which orbits are found in some seconds. */
#define MAX_ORBIT_WAVES 30.0

static bool is_affordable(const Device *device, double waves) {
    double limit = MAX_RATE * device->drive_frequency, wn = device->resonator_frequency;
    double free_share = device->slider_mass / device_total_mass(device);
    double damping = 2.0 * device->damping_ratio * wn / free_share;
    bool resonator = wn <= limit * sqrt(free_share) && damping <= limit;
    if (device->friction_law == 0) {
        return fabs(waves) <= MAX_ORBIT_WAVES && resonator;
    }
    double normal = device->normal_preload + device->normal_amplitude;
    double grip = device->friction_faces * normal / device->slider_mass;
    return fabs(waves) <= MAX_ORBIT_WAVES && resonator && grip * device->bristle_damping <= limit &&
           grip * device->bristle_stiffness <= limit * limit;
}

SlowPhase orbit_phase_of(const Law *law) {
    const Device *device = &law->device;
    SlowPhase slow = {.turns = 1, .waves = 1.0};
    if (device->normal_amplitude > 0.0) {
        slow = law_slow_phase(law);
    }
    if (!is_affordable(device, slow.waves)) {
        slow.turns = 0;
    }
    return slow;
}

OrbitSource orbit_source_of(const OrbitState *orbit, const Device *device, bool drifts) {
    bool lifts = device->normal_amplitude > device->normal_preload;
    bool many = orbit->leads.count > MAX_LEADS;
    if (orbit->tunings >= MAX_TUNINGS || ((drifts || many) && lifts)) {
        return FROM_SEARCH;
    }
    if (drifts) {
        return FROM_SERIES;
    }
    return many ? FROM_COMBINED : FROM_CURVE;
}

void ride_begin(OrbitRide *ride, const Law *law, const Moment *moment, double lead) {
    const Device *device = &law->device;
    const OrbitState *orbit = &moment->orbit;
    ride->law = law;
    ride->slow = orbit_phase_of(law);
    ride->map = orbit_map_of(law->orbits, device, &ride->slow);
    ride->lead = lead;
    ride->source = orbit_source_of(orbit, device, slow_phase_drifts(&ride->slow));
    if (ride->source == FROM_SERIES && !orbit_has_series(&orbit->paid, ride->slow.waves)) {
        ride->source = FROM_SEARCH;
    }
    ride->first = slow_friction_of(law, moment->theta, moment->psi);
    ride->searched = false;
    ride->stops = moment->stops;
    ride->unknown = 0.0;
    ride->max_maps = (int)(MAX_STEP_MAPS / (ride->slow.turns *
                                            (1.0 + fabs(law->inputs.frequency_ratio) / MAP_WAVES)));
    law->orbits->ride++;
    law->orbits->maps = 0;
    ride->may_search = ride->source == FROM_SEARCH;
    if (ride->source == FROM_CURVE || ride->source == FROM_COMBINED) {
        bool combined = ride->source == FROM_COMBINED;
        ride->curve = orbit_curve_of(law->orbits, device, &ride->slow, lead, combined);
        ride->may_search = combined && ride->curve->found;
    } else if (ride->source == FROM_SERIES) {
        ride->series = orbit_series_of(law->orbits, device, &ride->slow);
        ride->may_search = orbit_series_found(&ride->series);
    }
}

void ride_within(OrbitRide *ride, double duration) {
    double turns = ride->law->device.drive_frequency * duration / TAU;
    if (ride->source == FROM_SEARCH && !(turns > ride->max_maps)) {
        int maps = (int)(SEARCH_MAPS + SEARCH_MAPS_IN_TURN * turns);
        ride->max_maps = maps < ride->max_maps ? maps : ride->max_maps;
    }
}

double ride_lead(const OrbitRide *ride, double t) {
    return ride->lead + slow_phase_gain(&ride->slow, t);
}

/* Finds the orbit by Newton's method from a neighbour unless it is NULL, and counts the maps. */
static bool find(OrbitRide *ride, double lead, double velocity, const HeldOrbit *neighbour) {
    bool found = held_orbit_at(ride->map, lead, velocity, neighbour, &ride->last) == ORBIT_FOUND;
    ride->law->orbits->maps += found ? ride->last.maps : MAX_MAPS;
    return found;
}

/* Searches from the orbit found last, then without. */
static bool search(OrbitRide *ride, double t, double velocity) {
    double lead = ride_lead(ride, t);
    bool found = (ride->searched && find(ride, lead, velocity, &ride->last)) ||
                 find(ride, lead, velocity, NULL);
    if (found && ride->map->law.device.friction_law != 0) {
        ride->law->orbits->maps += ride->map->states + 2;
        found = held_orbit_linearise(ride->map, &ride->last) == ORBIT_FOUND;
    }
    ride->searched = found;
    return found;
}

static bool tabulated_point(OrbitRide *ride, double t, double velocity, OrbitPoint *point) {
    OrbitTables *tables = ride->law->orbits;
    if (ride->source == FROM_SERIES) {
        return orbit_series_at(tables, &ride->series, ride_lead(ride, t), velocity, point);
    }
    return ride->source != FROM_SEARCH && orbit_point_at(tables, ride->curve, velocity, point);
}

static bool tabulated_friction(OrbitRide *ride, double t, double velocity, double *friction,
                               double *factor) {
    OrbitTables *tables = ride->law->orbits;
    if (ride->source == FROM_SERIES) {
        return orbit_series_friction_at(tables, &ride->series, ride_lead(ride, t), velocity,
                                        friction, factor);
    }
    return ride->source != FROM_SEARCH &&
           orbit_friction_at(tables, ride->curve, velocity, friction, factor);
}

static bool known_point(OrbitRide *ride, double t, double velocity, OrbitPoint *point) {
    return tabulated_point(ride, t, velocity, point) ||
           (ride->may_search && search(ride, t, velocity) &&
            orbit_point_of(ride->map, &ride->last, point));
}

static bool known_friction(OrbitRide *ride, double t, double velocity, double *friction,
                           double *factor) {
    if (tabulated_friction(ride, t, velocity, friction, factor)) {
        return true;
    }
    if (!ride->may_search || !search(ride, t, velocity)) {
        return false;
    }
    *friction = ride->last.friction;
    *factor = ride->last.factor;
    return true;
}

double ride_acceleration(const void *rider, double t, double velocity) {
    OrbitRide *ride = *(OrbitRide *const *)rider;
    const Plant *plant = &ride->law->held.plant;
    double friction = 0.0, factor = 1.0;
    bool found = known_friction(ride, t, velocity, &friction, &factor);
    if (!found || ride->law->orbits->maps > ride->max_maps) {
        ride->unknown = TAU * (found ? (double)MAX_STEP_MAPS : MISSED_TURNS);
        return NAN;
    }
    double load = plant->load + plant->load_rate * t;
    return -factor * (friction + load) / plant->total_mass;
}

double ride_to_kink(const void *rider, double t) {
    const OrbitRide *ride = *(OrbitRide *const *)rider;
    return slow_friction_to_kink(&ride->first, t);
}

void ride_edges(const OrbitRide *ride, double edge[2], double *margin) {
    bool known = ride->source == FROM_CURVE && ride->curve->found;
    double fast = ride->law->fast.velocity, middle = known ? ride->curve->middle : 0.0;
    double reach = known ? ride->curve->reach : fast;
    edge[0] = middle - reach;
    edge[1] = middle + reach;
    *margin = known || ride->source == FROM_CURVE ? 0.0 : GRAZING_BAND * fast;
}

OrbitPoint ride_point(OrbitRide *ride, double t, double velocity) {
    OrbitPoint point;
    if (known_point(ride, t, velocity, &point)) {
        return point;
    }
    ride->unknown = TAU * MISSED_TURNS;
    const PeriodMap *map = ride->map;
    int direction = velocity >= 0.0 ? FORWARD : BACKWARD;
    Response swing = steady_swing(map->fast.resonator, section_phase(map, direction),
                                  map->law.held.plant.drive_frequency);
    point = (OrbitPoint){.direction = direction};
    point.of[ORBIT_FRICTION] = slow_friction_at(&ride->first, t, velocity);
    point.of[ORBIT_FACTOR] = 1.0;
    point.of[ORBIT_DISPLACEMENT] = swing.displacement;
    point.of[ORBIT_RATE] = swing.rate;
    point.of[ORBIT_BRISTLE] = map->states > 3 ? direction * map->law.bristle.coefficient : 0.0;
    return point;
}

double ride_theta(const OrbitRide *ride, double t, double theta, double chi) {
    double best = INFINITY, phase = theta, lead = ride_lead(ride, t);
    for (int turn = 0; turn < ride->slow.turns; turn++) {
        double there = theta + TAU * turn;
        double miss = fabs(remainder(chi - lead - ride->slow.waves * there, TAU));
        if (miss < best) {
            best = miss;
            phase = there;
        }
    }
    return phase;
}

bool ride_moment(OrbitRide *ride, double t, double theta, double velocity, double centre,
                 Moment *moment, OrbitPoint *point) {
    const PeriodMap *map = ride->map;
    double w = map->law.held.plant.drive_frequency, share = map->law.held.plant.mass_fraction;
    double lead = ride_lead(ride, t);
    *point = ride_point(ride, t, velocity);
    double start = section_phase(map, point->direction), carried = share * point->of[ORBIT_RATE];
    Moment section = {.bristle = point->of[ORBIT_BRISTLE], .stops = ride->stops};
    section.stops.backward.drift = section.stops.forward.drift = 0.0;
    section.state.displacement = point->of[ORBIT_DISPLACEMENT];
    section.state.rate = point->of[ORBIT_RATE];
    section.state.velocity = velocity + point->of[ORBIT_OFFSET] - carried -
                             map->fast.pair_velocity * cos(start);
    orbit_enter(map, lead, start, &section);
    double ahead = theta - start, period = TAU * map->turns;
    ahead -= period * floor(ahead / period);
    double duration = ahead / w;
    *moment = section;
    if (duration > 0.0 &&
        !orbit_advance(map, lead, -point->of[ORBIT_FRICTION], &section, duration, moment)) {
        return false;
    }
    ride->stops = moment->stops;
    moment->position += centre + point->of[ORBIT_WAY] - share * section.state.displacement -
                        map->fast.pair_velocity / w * sin(start) - velocity * duration;
    return true;
}
