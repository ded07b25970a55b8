#include "regular_slide.h"

#include <math.h>

/* Lower limit of frequencies in the scale of velocities, as a share of the fastest one. */
#define SLOWEST 0.02

void regular_slide_begin(RegularSlide *slide, const Plant *plant, int sign, const State *state,
                         double theta, double chi, int direction) {
    double w = plant->drive_frequency, q = plant->normal_frequency;
    double resisting = sign * plant->friction_preload + plant->load;
    Complex drive_turn = complex_of(sin(theta), -cos(theta));
    double amplitude = sign * plant->friction_amplitude;
    Complex friction = complex_of(amplitude * sin(chi), -amplitude * cos(chi));
    Forcing forcing[FORCINGS] = {{w, complex_scale(plant->relative_drive, drive_turn)},
                                 {q, complex_scale(1.0 / plant->slider_mass, friction)}};
    slide->plant = plant;
    slide->direction = direction;
    slide->start = *state;
    slide->deceleration = resisting / plant->total_mass;
    slide->deceleration_rate = plant->load_rate / plant->total_mass;
    slide->pair[0] = (Forcing){w, complex_mul(plant->drive, drive_turn)};
    slide->pair[1] = (Forcing){q, complex_scale(-1.0 / plant->total_mass, friction)};
    slide->pair_bound = complex_abs(slide->pair[0].amplitude) * w +
                        complex_abs(slide->pair[1].amplitude) * fabs(q) +
                        fabs(slide->deceleration_rate);
    slide->own_bound = (complex_abs(plant->holding_drive) * w +
                        plant->friction_amplitude * fabs(q) + fabs(plant->load_rate)) /
                       plant->slider_mass;
    forced_oscillator_begin(&slide->resonator, &plant->slip, resisting / plant->slider_mass,
                            plant->load_rate / plant->slider_mass, forcing, FORCINGS,
                            state->displacement, state->rate, fmax(w, fabs(q)));
}

static double velocity_at(const RegularSlide *slide, double t, double rate, const Complex *turn) {
    double velocity =
        slide->start.velocity - (slide->deceleration + 0.5 * slide->deceleration_rate * t) * t;
    for (int i = 0; i < FORCINGS; i++) {
        Complex integral = exponential_integral(slide->pair[i].frequency, t, turn[i]);
        velocity += complex_mul(slide->pair[i].amplitude, integral).re;
    }
    return velocity - slide->plant->mass_fraction * (rate - slide->start.rate);
}

/* Bound on the second derivative of the velocity [m/s^3]: the smaller one of those from the momentum of the
 * pair and from the force between slider and resonator, which is better for a light resonator. */
static double bound_of(const RegularSlide *slide, const Sample *sample) {
    const Plant *plant = slide->plant;
    double by_pair = slide->pair_bound + plant->mass_fraction * sample->jerk_bound;
    double between =
        plant->spring * sample->rate_bound + plant->damper * sample->acceleration_bound;
    double by_slider = slide->own_bound + between / plant->slider_mass;
    return by_slider < by_pair ? by_slider : by_pair;
}

static Signal velocity_ahead(void *motion, double t) {
    const RegularSlide *slide = motion;
    double fraction = slide->plant->mass_fraction;
    double acceleration = -slide->deceleration - slide->deceleration_rate * t;
    double bound = slide->pair_bound, rate = 0.0;
    Sample sample;
    if (fraction != 0.0) {
        sample = forced_oscillator_sample(&slide->resonator, t);
        rate = sample.rate;
        acceleration -= fraction * sample.acceleration;
        bound = bound_of(slide, &sample);
    } else {
        turns_of(slide->pair, FORCINGS, t, sample.turn);
    }
    for (int i = 0; i < FORCINGS; i++) {
        acceleration += complex_mul(slide->pair[i].amplitude, sample.turn[i]).re;
    }
    return (Signal){slide->direction * velocity_at(slide, t, rate, sample.turn),
                    slide->direction * acceleration, bound};
}

Watch regular_slide_watch(RegularSlide *slide) {
    const Plant *plant = slide->plant;
    double fastest = fmax(plant->drive_frequency, fabs(plant->normal_frequency));
    double horizon = INFINITY, rate = 0.0;
    if (plant->mass_fraction != 0.0) {
        fastest = fmax(fastest, plant->slip.frequency);
        horizon = slide->resonator.horizon;
        rate = forced_oscillator_reach(&slide->resonator).rate;
    }
    double scale = fabs(slide->start.velocity);
    for (int i = 0; i < FORCINGS; i++) {
        double frequency = fmax(fabs(slide->pair[i].frequency), SLOWEST * fastest);
        scale += complex_abs(slide->pair[i].amplitude) / frequency;
    }
    if (rate < INFINITY) {
        scale += plant->mass_fraction * rate;
    }
    return (Watch){velocity_ahead, slide, 2.0 * EPSILON * scale, fastest, horizon};
}

static double travel_by(const RegularSlide *slide, double t, const Response *resonator) {
    const State *start = &slide->start;
    double mean = 0.5 * slide->deceleration + slide->deceleration_rate * t / 6.0;
    double travel = start->velocity * t - mean * t * t;
    for (int i = 0; i < FORCINGS; i++) {
        Complex integral = exponential_double_integral(slide->pair[i].frequency, t);
        travel += complex_mul(slide->pair[i].amplitude, integral).re;
    }
    double moved = resonator->displacement - start->displacement;
    return travel - slide->plant->mass_fraction * (moved - start->rate * t);
}

State regular_slide_end(const RegularSlide *slide, double t, double *travel) {
    Complex turn[FORCINGS];
    turns_of(slide->pair, FORCINGS, t, turn);
    Response resonator = forced_oscillator_response(&slide->resonator, t, turn);
    *travel = travel_by(slide, t, &resonator);
    return (State){velocity_at(slide, t, resonator.rate, turn), resonator.displacement,
                   resonator.rate};
}

double regular_slide_travel(const RegularSlide *slide, double t) {
    double travel;
    regular_slide_end(slide, t, &travel);
    return travel;
}
