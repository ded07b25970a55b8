/* Shifts of time along a curve of orbits, measured where they are asked for. */
#ifndef SLIDER_SHIFT_TABLES_H
#define SLIDER_SHIFT_TABLES_H

#include "orbit_tables.h"

/* Shifts at a velocity, see OrbitShift: 0 beyond grazing. The time by which the lag is `unsure` [s]. */
typedef struct {
    double lag, of_turn, added_mass, swing, unsure;
} ShiftsThere;

/* The shifts at a velocity [m/s], the lag at a part `phase`, 0 up to 1, of a period from drive phase 0 on. False
 * where an orbit cannot be probed. */
bool orbit_shifts_at(OrbitTables *tables, OrbitCurve *curve, double velocity, double phase,
                     ShiftsThere *shifts);

/* What is gained [s] from one velocity [m/s] to another, and how `unsure` [s] that is; false as above. */
bool orbit_shift_gained(OrbitTables *tables, OrbitCurve *curve, double from, double to,
                        double *gained, double *unsure);

#endif
