#include "contact.h"

#include "../base/elementary.h"

/* Distance [rad] from a boundary within which it counts as reached: rounding. The shortest flight that floating point
 * numbers can describe is 3e-8 rad long. */
#define REACHED 1e-12

bool is_lifted(const Plant *plant, double chi, double frequency) {
    const FlightWindow *window = &plant->window;
    if (!window->exists) {
        return false;
    }
    double width = window->last - window->first;
    if (width >= TAU) {
        return true;
    }
    double inside = within_turn(chi - window->first);
    if (TAU - inside < REACHED) {
        inside -= TAU;
    }
    if (frequency > 0.0) {
        return -REACHED < inside && inside < width - REACHED;
    }
    return (frequency < 0.0 ? REACHED : -REACHED) < inside && inside < width + REACHED;
}

double time_to_switch(const Plant *plant, double chi, double frequency, double rate, bool lifted) {
    const FlightWindow *window = &plant->window;
    double going = frequency != 0.0 ? frequency : rate;
    if (!window->exists || going == 0.0 || window->last - window->first >= TAU) {
        return INFINITY;
    }
    bool to_last = lifted == (going > 0.0);
    double ahead = (to_last ? window->last : window->first) - chi;
    ahead = within_turn(going > 0.0 ? ahead : -ahead);
    if (ahead == 0.0 || TAU - ahead < REACHED) {
        return 0.0;
    }
    double speed = fabs(frequency), gain = going > 0.0 ? rate : -rate;
    if (rate == 0.0) {
        return ahead / speed;
    }
    double square = speed * speed + 2.0 * gain * ahead;
    return square >= 0.0 ? 2.0 * ahead / (speed + sqrt(square)) : INFINITY;
}

double friction_limit(const Plant *plant, double psi) {
    double limit = plant->friction_preload + plant->friction_amplitude * sin(psi + plant->phase);
    return limit > 0.0 ? limit : 0.0;
}
