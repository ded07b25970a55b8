#include "departure.h"

#include "elementary.h"

double departure_time(const Plant *plant, int sign, const State *state, double theta, double chi) {
    double w = plant->drive_frequency, q = plant->normal_frequency;
    double amplitude = sign * plant->friction_amplitude, load_rate = amplitude * q * cos(chi);
    double drive_sine = sin(theta), drive_cosine = cos(theta);
    Complex direct = complex_mul(complex_of(drive_sine, -drive_cosine), plant->holding_drive);
    double force_rate = -w * direct.im - load_rate - plant->load_rate;
    double horizon = 1.0 / fmax(fmax(w, fabs(q)), plant->slip.frequency);
    double highest = fabs(q) + fabs(plant->normal_rate) * horizon;
    double load_bound =
        fabs(amplitude) * highest * highest + fabs(amplitude) * fabs(plant->normal_rate);
    double force_bound = complex_abs(plant->holding_drive) * w * w + load_bound;
    if (plant->mass_fraction != 0.0) {
        double decay = plant->slip.decay, stiffness = plant->slip.stiffness;
        double frequency = plant->slip.frequency;
        double resisting = sign * plant->friction_preload + amplitude * sin(chi) + plant->load;
        double forcing = plant->relative_drive * drive_sine + resisting / plant->slider_mass;
        double forcing_rate = plant->relative_drive * w * drive_cosine +
                              (load_rate + plant->load_rate) / plant->slider_mass;
        double forcing_bound = fabs(plant->relative_drive) * w * w + load_bound / plant->slider_mass;
        double second = forcing - 2.0 * decay * state->rate - stiffness * state->displacement;
        double third = forcing_rate - 2.0 * decay * second - stiffness * state->rate;
        double energy = hypot(third, frequency * second) + horizon * forcing_bound;
        force_rate += plant->spring * state->rate + plant->damper * second;
        force_bound += (plant->spring / frequency + plant->damper) * energy;
    }
    double jerk = sign * force_rate;
    if (!(jerk > 0.0)) {
        return 0.0;
    }
    return 3.0 * jerk >= force_bound * horizon ? horizon : 3.0 * jerk / force_bound;
}
