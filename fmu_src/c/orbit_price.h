/* What the tables of held orbits cost, and which are paid for.
 *
 * A table pays where motion stays with it. So inputs that ask for another one are followed by resolved
 * motion first, for as long as costs what the table does: whether they change soon or stay, motion costs
 * about twice the cheaper way at most. From the start on a lead that drifts is followed by searches for as
 * long. The state says what is paid for, as the tables are a cache. */
#ifndef SLIDER_ORBIT_PRICE_H
#define SLIDER_ORBIT_PRICE_H

#include "law.h"

/* Note a visit of a lead [rad]. */
void orbit_visit(VisitedLeads *leads, double lead);

/* Drive angle [rad] of resolved motion that costs what it does to go on at a lead [rad] under present values:
 * 0 where its tables are paid for. `changed` is whether the values differ from those of the last step. */
double orbit_price(const Law *law, const OrbitState *orbit, double lead, bool changed);

/* Whether the series over leads is paid for, of these waves in a turn. */
bool orbit_has_series(const PaidTables *paid, double waves);

/* Whether the motion that waited for its tables has cost as much as they do. That counts for the series over
 * leads alone: until then orbits are searched. */
bool orbit_is_due(const Law *law, const OrbitState *orbit);

/* Note that the tables of a lead [rad] are paid for. */
void orbit_pay(const Law *law, OrbitState *orbit, double lead);

#endif
