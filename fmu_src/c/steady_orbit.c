#include "steady_orbit.h"

#include <stdbool.h>
#include <stddef.h>

#include "elementary.h"
#include "state.h"

/* Number of velocities at which steady motion is looked for, and largest number of halvings between two. */
enum { SAMPLES = 12, MAX_HALVINGS = 60 };

/* Largest sampled velocity, in v_q: beyond grazing unless friction is strong. */
#define SAMPLED_REACH 1.05

/* Amplitude [m/s] of the vibration from which on squares leave the range of floating point, so that no
 * iteration would converge. */
#define MAX_SPEED 1e150

/* Distance in v_q of velocities from which orbits lead to others of the velocity between them, and velocity
 * from which on the slider does not turn back, of further ones. */
#define BESIDE 0.1
#define FAR 2.0

/* Force, over full friction, that is rounding or the tolerance of a map. */
#define NOISE 1e-9

/* Distance in v_q of a neighbour that must not be in balance as well. */
#define APART 0.01

/* Two velocities [m/s]: at `low` friction and load together accelerate the slider, at `high` they brake it.
 * `orbit` is that of one of them. */
typedef struct {
    double low, high;
    HeldOrbit orbit;
} Bracket;

/* Finds the steady motion in a bracket: by Newton's method from its orbit, with bisection where that leaves
 * the bracket. */
static OrbitStatus refine(const PeriodMap *map, double lead, double load, Bracket *bracket,
                          HeldOrbit *orbit) {
    OrbitStatus status = ORBIT_NOT_CONVERGED;
    for (int halving = 0; halving < MAX_HALVINGS; halving++) {
        status = steady_orbit_at(map, lead, load, &bracket->orbit, orbit);
        if (status == ORBIT_FOUND && bracket->low <= orbit->velocity &&
            orbit->velocity <= bracket->high) {
            return status;
        }
        double middle = 0.5 * (bracket->low + bracket->high);
        status = held_orbit_at(map, lead, middle, &bracket->orbit, &bracket->orbit);
        if (status != ORBIT_FOUND) {
            return status;
        }
        *(bracket->orbit.friction + load > 0.0 ? &bracket->high : &bracket->low) = middle;
    }
    return ORBIT_NOT_CONVERGED;
}

/* Result of the samples so far: `low`, the highest velocity [m/s] at which friction and load accelerate the
 * slider; `drives`, whether a bracket is open from there; the number of brackets (`count`) and the last one. */
typedef struct {
    double low;
    bool drives;
    int count;
    Bracket bracket;
} Scan;

/* Adds a sample: a velocity [m/s], the `excess` of friction and load there [N], and its orbit. One in balance
 * lies within a bracket. */
static void scan_on(Scan *scan, double velocity, double excess, double noise,
                    const HeldOrbit *sample) {
    if (excess < -noise) {
        scan->low = velocity;
        scan->drives = true;
    } else if (excess > noise && scan->drives) {
        scan->count++;
        scan->bracket = (Bracket){scan->low, velocity, *sample};
        scan->drives = false;
    }
}

/* Whether the orbit is one of a family that all hold the load, so that none is the steady one. */
static bool is_neutral(const PeriodMap *map, const HeldOrbit *orbit, double load, double noise) {
    for (int side = -1; side <= 1; side += 2) {
        double velocity = orbit->velocity + side * APART * map->speed;
        HeldOrbit neighbour;
        if (held_orbit_at(map, orbit->lead, velocity, orbit, &neighbour) == ORBIT_FOUND &&
            fabs(neighbour.friction + load) <= noise) {
            return true;
        }
    }
    return false;
}

OrbitStatus steady_orbit(const PeriodMap *map, double lead, double load, HeldOrbit *orbit) {
    double sliding = sliding_friction(map, lead), noise = NOISE * sliding;
    double reach = 2.0 * SAMPLED_REACH * map->speed;
    bool known = false;
    OrbitStatus failure = ORBIT_RUNS_AWAY;
    HeldOrbit sample = {0};
    Scan scan = {0};
    if (!(map->speed < MAX_SPEED)) {
        return ORBIT_NOT_CONVERGED;
    }
    scan_on(&scan, -reach, load - sliding, noise, &sample);
    for (int i = 0; i < SAMPLES; i++) {
        double velocity = -SAMPLED_REACH * map->speed * cos(PI * (i + 0.5) / SAMPLES);
        OrbitStatus status = held_orbit_at(map, lead, velocity, known ? &sample : NULL, &sample);
        known = status == ORBIT_FOUND;
        if (known) {
            scan_on(&scan, velocity, load + sample.friction, noise, &sample);
        } else {
            failure = status;
        }
    }
    scan_on(&scan, reach, load + sliding, noise, &sample);
    if (scan.count != 1) {
        return scan.count == 0 ? failure : ORBIT_UNDETERMINED;
    }
    OrbitStatus status = refine(map, lead, load, &scan.bracket, orbit);
    if (status != ORBIT_FOUND) {
        return status;
    }
    return is_neutral(map, orbit, load, noise) ? ORBIT_UNDETERMINED
                                               : held_orbit_check_stable(map, orbit);
}

OrbitStatus blocking_orbit(const PeriodMap *map, double lead, HeldOrbit *orbit, double *force) {
    OrbitStatus status = held_orbit_at(map, lead, 0.0, NULL, orbit);
    if (status == ORBIT_FOUND) {
        status = held_orbit_check_stable(map, orbit);
    }
    *force = status == ORBIT_FOUND ? -orbit->friction : 0.0;
    return status;
}

bool is_unique(const PeriodMap *map, const HeldOrbit *orbit) {
    double velocity = orbit->velocity;
    const double starts[] = {velocity - BESIDE * map->speed, velocity + BESIDE * map->speed,
                             -FAR * map->speed, FAR * map->speed};
    for (size_t i = 0; i < sizeof starts / sizeof *starts; i++) {
        HeldOrbit neighbour, other;
        if (held_orbit_at(map, orbit->lead, starts[i], NULL, &neighbour) == ORBIT_FOUND &&
            held_orbit_at(map, orbit->lead, velocity, &neighbour, &other) == ORBIT_FOUND &&
            !is_same_orbit(map, orbit, &other)) {
            return false;
        }
    }
    return true;
}
