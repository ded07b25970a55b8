#include "stick.h"

#include "elementary.h"

void stick_begin(Stick *stick, const Plant *plant, const State *state, double theta, double chi) {
    double w = plant->drive_frequency, q = plant->normal_frequency;
    Complex drive_turn = complex_of(sin(theta), -cos(theta));
    Forcing forcing = {w, complex_scale(plant->base_acceleration, drive_turn)};
    stick->plant = plant;
    stick->direct = complex_mul(plant->holding_drive, drive_turn);
    stick->normal =
        complex_scale(plant->friction_amplitude, complex_of(sin(chi), -cos(chi)));
    double fastest = fabs(q) + fabs(plant->normal_rate) * LONGEST_ARC / fmax(w, fabs(q));
    double swing = complex_abs(stick->normal);
    stick->fixed_bound = swing * fastest * fastest + swing * fabs(plant->normal_rate) +
                         complex_abs(stick->direct) * w * w;
    forced_oscillator_begin(&stick->resonator, &plant->stick, 0.0, 0.0, &forcing, 1,
                            state->displacement, state->rate, fmax(w, fabs(q)));
}

static Signal margin(const Stick *stick, double direction, double t) {
    const Plant *plant = stick->plant;
    double w = plant->drive_frequency, q = plant->normal_frequency + plant->normal_rate * t;
    double turned = turned_by(plant, t);
    double needed = -plant->load - plant->load_rate * t, change = -plant->load_rate;
    Signal signal = {0.0, 0.0, stick->fixed_bound};
    Complex drive_turn;
    if (plant->spring != 0.0) {
        Sample sample = forced_oscillator_sample(&stick->resonator, t);
        drive_turn = sample.turn[0];
        needed += plant->spring * sample.displacement + plant->damper * sample.rate;
        change += plant->spring * sample.rate + plant->damper * sample.acceleration;
        signal.bound +=
            plant->spring * sample.acceleration_bound + plant->damper * sample.jerk_bound;
    } else {
        drive_turn = complex_rect(1.0, w * t);
    }
    Complex held = complex_mul(stick->direct, drive_turn);
    Complex turn = turned == w * t ? drive_turn : complex_rect(1.0, turned);
    Complex limit = complex_mul(stick->normal, turn);
    needed += held.re;
    change -= w * held.im;
    signal.value = plant->friction_preload + limit.re - direction * needed;
    signal.slope = -q * limit.im - direction * change;
    return signal;
}

static Signal forward_margin(void *stick, double t) {
    return margin(stick, 1.0, t);
}

static Signal backward_margin(void *stick, double t) {
    return margin(stick, -1.0, t);
}

int stick_watches(Stick *stick, double longest, Watch watches[2]) {
    const Plant *plant = stick->plant;
    double reach = fabs(plant->load) + fabs(plant->load_rate) * longest + complex_abs(stick->direct);
    double fastest = fmax(plant->drive_frequency, fabs(plant->normal_frequency));
    double horizon = INFINITY;
    if (plant->spring != 0.0) {
        Response resonator = forced_oscillator_reach(&stick->resonator);
        bool bounded = resonator.displacement < INFINITY; /* a damper may be 0 */
        reach += bounded ? plant->spring * resonator.displacement + plant->damper * resonator.rate
                         : INFINITY;
        horizon = stick->resonator.horizon;
        fastest = fmax(fastest, plant->stick.frequency);
    }
    double limit = plant->friction_preload + plant->friction_amplitude;
    double least = plant->friction_preload - plant->friction_amplitude;
    if (reach == 0.0 || reach < 0.999999 * least) {
        return 0;
    }
    double noise = 4.0 * EPSILON * (limit + fmin(reach, 1e3 * limit));
    watches[0] = (Watch){forward_margin, stick, noise, fastest, horizon};
    watches[1] = (Watch){backward_margin, stick, noise, fastest, horizon};
    return 2;
}

State stick_state(const Stick *stick, double t) {
    Complex turn = complex_rect(1.0, stick->plant->drive_frequency * t);
    Response response = forced_oscillator_response(&stick->resonator, t, &turn);
    return (State){0.0, response.displacement, response.rate};
}
