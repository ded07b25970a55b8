/* The tables of held orbits of an instance: a cache of pure functions of device and lead. */
#ifndef SLIDER_ORBIT_TABLES_H
#define SLIDER_ORBIT_TABLES_H

#include <stdbool.h>

#include "orbit_curve.h"
#include "slow_phase.h"

/* Leads between which orbits are interpolated by a Fourier series, and curves that are kept: those, a
 * combination of them, and the curves of MAX_LEADS leads. */
enum { SERIES_LEADS = 9, CURVES = 14 };

/* Most halvings of panels between which orbits are interpolated over leads: each is one for all leads, and orbits
 * that need smaller ones are searched. */
enum { SERIES_DEPTH = 2 };

/* Zeroed memory holds no table. `map` is the one that was used last, of these `waves`. `maps` counts the period
 * maps of all that the ride of number `ride` has asked for, whether it was tabulated before or not. `bending` is a cache
 * for panels of LuGre friction on the map, see Law; NULL where it takes series. */
typedef struct OrbitTables {
    bool mapped;
    PeriodMap map;
    Device device;
    struct BendingTables *bending;
    long clock, ride;
    int maps;
    OrbitCurve curve[CURVES];
} OrbitTables;

/* The period map of the full device; NULL where there is none. It stays until another is asked for. */
const PeriodMap *orbit_map_of(OrbitTables *tables, const Device *device, const SlowPhase *slow);

/* The curve at a lead [rad], whose panels come from orbits, or, if `combined`, from the curves at
 * SERIES_LEADS leads: that serves a contact that does not lift. It stays until CURVES others were asked
 * for. */
OrbitCurve *orbit_curve_of(OrbitTables *tables, const Device *device, const SlowPhase *slow,
                           double lead, bool combined);

/* The curve of the series that has a share in one combined, and the weights [SERIES_LEADS] of those at a lead. */
OrbitCurve *orbit_curve_in_series(OrbitTables *tables, const OrbitCurve *curve, int index);
void orbit_series_weights(double lead, double weight[SERIES_LEADS]);

/* Place of a velocity [m/s] among the base panels of a curve, from 0 on; negative beyond grazing. */
double orbit_place(const OrbitCurve *curve, double velocity);

/* All quantities at a velocity [m/s]; false where there is no orbit, or where panels of a combined curve are not
 * wide. */
bool orbit_point_at(OrbitTables *tables, OrbitCurve *curve, double velocity, OrbitPoint *point);

/* The `friction` [N] and `factor` alone. */
bool orbit_friction_at(OrbitTables *tables, OrbitCurve *curve, double velocity, double *friction,
                       double *factor);

/* The curves of the series over the lead. */
typedef struct {
    OrbitCurve *part[SERIES_LEADS];
} OrbitSeries;

OrbitSeries orbit_series_of(OrbitTables *tables, const Device *device, const SlowPhase *slow);

/* Whether there are orbits at all leads of the series. */
bool orbit_series_found(const OrbitSeries *series);

/* All quantities at a lead [rad] and a velocity [m/s] by the series; false where there is no orbit, or where
 * their panels are not wide. */
bool orbit_series_at(OrbitTables *tables, const OrbitSeries *series, double lead, double velocity,
                     OrbitPoint *point);

bool orbit_series_friction_at(OrbitTables *tables, const OrbitSeries *series, double lead,
                              double velocity, double *friction, double *factor);

#endif
