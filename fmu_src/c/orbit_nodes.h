/* The orbits at the nodes of a panel.
 *
 * Nodes are added until a polynomial through those before has the values at two of them. What is known of the
 * panel is the first guess of the next orbit. */
#ifndef SLIDER_ORBIT_NODES_H
#define SLIDER_ORBIT_NODES_H

#include "orbit_curve.h"

/* Make a panel that was begun from orbits. */
void orbit_panel_make(OrbitPanel *panel, const OrbitCurve *curve, const PeriodMap *map);

#endif
