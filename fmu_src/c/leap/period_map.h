/* The period map: resolved motion of the full device, seen once in each period of the normal load.
 *
 * It is seen at a section: the phase of the drive at which the vibration is fastest forward, where no reversal comes
 * unless sliding is about to end reversing at all. There the slow state is the slow velocity V and the position X. The
 * fast state is the resonator's Y and Y' and, with LuGre friction, the bristle. From period to period both change
 * slowly and smoothly (stroboscopic averaging: Calvo, Chartier, Murua, Sanz-Serna 2011). */
#pragma once

#include <stdint.h>

#include "../device/budget.h"
#include "../friction/system.h"

/* Largest number of fast states: Y [m], Y' [m/s], and the bristle's friction per unit load. */
enum { MAX_FAST = 3 };

/* The motion at a section, as numbers: slow velocity V [m/s], the fast states, position X [m], number of reversals. */
enum { SLOW_VELOCITY, FAST_STATES, SLOW_POSITION = FAST_STATES + MAX_FAST, REVERSALS, NUMBERS };

typedef struct {
    double at[NUMBERS];
} SectionState;

/* The period map under the inputs of `system`, which may grow. `scale` is the error of a fast state that is as large as
 * the vibration, or changes V by v_q times `share`. */
typedef struct {
    System system;          /* the full device under its inputs, with the tolerance of maps */
    int turns;              /* turns of the drive in a period, after which the normal load repeats */
    double period;          /* the time of these [s] */
    double drift;           /* by which the phase of the load does not repeat [rad] */
    double section;         /* drive phase of the section [rad] */
    double speed;           /* fast velocity v_q [m/s] */
    double share;           /* change of V by full friction in a period, over v_q */
    double tolerance;       /* error of V that leaps may make, over v_q */
    int fast_count;         /* number of fast states */
    double scale[MAX_FAST]; /* their scales, in their units */
    double resolvent[2][2]; /* inverse of A - 1, A the map of Y and Y' over a period without friction */
    double kept;            /* what remains of a bristle's deflection after a period */
    double decay;           /* largest factor by which a transient decays in a period */
} PeriodMap;

/* Number of turns of the drive, at most `max_turns`, after which the normal load repeats, but for rounding or a
 * distance of the waves from an integer of at most `near` over that number; 0 if it does not. */
int turns_of_period(const System *system, int max_turns, double near);

/* Prepare the map of a system of the full device, for a load that repeats after that number of turns. Return false
 * where there is none: where the load does not repeat, without vibration, or where transients do not decay. */
bool period_map_prepare(PeriodMap *map, const System *system, int turns);

/* Phase of the normal load [rad] at the section `periods` after it was `psi` [rad], as the inputs of the system began
 * to grow; between whole periods, that of a section which the drift would bring there. */
double psi_after(const PeriodMap *map, double psi, double periods);

/* Put a moment to the slow velocity V [m/s] and the fast states of a section at normal phase `psi` [rad]. */
void moment_place(const PeriodMap *map, double velocity, const double fast[MAX_FAST], double psi, Moment *moment);

/* Advance a moment at the section, `begin` periods after the inputs of the system began to grow, by `count` periods.
 * `sections` are the motion at the count + 1 sections, from the first on, `itinerary` the hash of the contact modes.
 * Return false if the motion is refused or leaves the range of floating point. */
bool map_periods(const PeriodMap *map, double begin, int count, Moment *moment, Budget *budget, SectionState *sections,
                 uint64_t *itinerary);

/* Apply `resolvent` to fast states, `times` times: the change of the fast state that undoes their differences of that
 * order. */
void apply_resolvent(const PeriodMap *map, int times, double fast[MAX_FAST]);

/* Size of a change of the fast state, over the scales. */
double fast_size(const PeriodMap *map, const double fast[MAX_FAST]);
