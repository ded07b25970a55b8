#include "contact.h"

/* Distance [rad] from a boundary within which it counts as reached: rounding. The shortest flight that floating point
 * numbers can describe is 3e-8 rad long. */
#define REACHED 1e-12

bool is_lifted(const Plant *plant, double psi) {
    const FlightWindow *window = &plant->window;
    if (!window->exists) {
        return false;
    }
    double width = window->last - window->first, frequency = plant->normal_frequency;
    if (width >= TAU) {
        return true;
    }
    double inside = within_turn(psi + plant->phase - window->first);
    if (TAU - inside < REACHED) {
        inside -= TAU;
    }
    if (frequency > 0.0) {
        return -REACHED < inside && inside < width - REACHED;
    }
    return (frequency < 0.0 ? REACHED : -REACHED) < inside && inside < width + REACHED;
}

double time_to_switch(const Plant *plant, double psi, bool lifted) {
    const FlightWindow *window = &plant->window;
    double frequency = plant->normal_frequency, rate = plant->normal_rate;
    double going = frequency != 0.0 ? frequency : rate;
    if (!window->exists || going == 0.0 || window->last - window->first >= TAU) {
        return INFINITY;
    }
    bool to_last = lifted == (going > 0.0);
    double ahead = (to_last ? window->last : window->first) - (psi + plant->phase);
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
