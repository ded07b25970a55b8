#include "stick.h"

#include "../base/elementary.h"

/* Horizon of the bounds of a response from rest, as an angle [rad] of the oscillator: longer than most sticks. */
#define AHEAD 5.0

void stick_begin(Stick *stick, const Plant *plant, const Moment *now) {
    double w = plant->drive_frequency, q = plant->normal_frequency, chi = now->psi + plant->phase;
    Complex drive_turn = complex_of(sin(now->theta), -cos(now->theta)), steady = complex_of(0.0, 0.0);
    stick->plant = plant;
    stick->direct = complex_mul(plant->holding_drive, drive_turn);
    stick->normal = complex_scale(plant->friction_amplitude, complex_of(sin(chi), -cos(chi)));
    double fastest = fabs(q) + fabs(plant->normal_rate) * LONGEST_ARC / fmax(w, fabs(q));
    double swing = complex_abs(stick->normal);
    stick->fixed_bound =
        swing * fastest * fastest + swing * fabs(plant->normal_rate) + complex_abs(stick->direct) * w * w;
    stick->forcing = complex_scale(plant->base_acceleration, drive_turn);
    stick->resonates = resonates(&plant->stick, w);
    stick->horizon = stick->resonates ? AHEAD / fmax(plant->stick.frequency, w) : INFINITY;
    if (!stick->resonates) {
        steady = complex_mul(stick->forcing, transfer(&plant->stick, w));
    }
    stick->steady = steady;
    stick->free_start = (Response){now->state.displacement - steady.re, now->state.rate + w * steady.im};
}

/* Response to the drive at a time [s]. */
static Response forced_at(const Stick *stick, double t, Complex drive_turn) {
    double w = stick->plant->drive_frequency;
    if (stick->resonates) {
        return response_from_rest(&stick->plant->stick, stick->forcing, w, t, drive_turn);
    }
    Complex steady = complex_mul(stick->steady, drive_turn);
    return (Response){steady.re, -w * steady.im};
}

/* Motion of the resonator, with bounds on its acceleration and the derivative of that over the horizon. */
typedef struct {
    double displacement, rate, acceleration, acceleration_bound, jerk_bound;
} Sample;

/* The energy of the free part never grows, so that at a time `t` [s] bounds it later. */
static Sample sample_at(const Stick *stick, double t, Complex drive_turn) {
    const Oscillator *oscillator = &stick->plant->stick;
    double decay = oscillator->decay, stiffness = oscillator->stiffness;
    double frequency = oscillator->frequency, w = stick->plant->drive_frequency;
    Response response = free_response(oscillator, t);
    Response free = free_motion(oscillator, stick->free_start, response);
    Response forced = forced_at(stick, t, drive_turn);
    double second = -2.0 * decay * free.rate - stiffness * free.displacement;
    double energy = hypot(2.0 * decay * second + stiffness * free.rate, frequency * second);
    Sample sample = {free.displacement + forced.displacement, free.rate + forced.rate, 0.0, energy / frequency, energy};
    sample.acceleration =
        complex_mul(stick->forcing, drive_turn).re - 2.0 * decay * sample.rate - stiffness * sample.displacement;
    if (stick->resonates) {
        double growing = w + 2.0 * decay + frequency + (t + stick->horizon) * w * w;
        double jerk = complex_abs(stick->forcing) * growing;
        sample.acceleration_bound += jerk / frequency;
        sample.jerk_bound += jerk;
    } else {
        double acceleration = complex_abs(stick->steady) * w * w;
        sample.acceleration_bound += acceleration;
        sample.jerk_bound += acceleration * w;
    }
    return sample;
}

static Signal margin(const Stick *stick, double direction, double t) {
    const Plant *plant = stick->plant;
    double w = plant->drive_frequency, q = plant->normal_frequency + plant->normal_rate * t;
    double turned = turned_by(plant, t);
    double needed = -plant->load - plant->load_rate * t, change = -plant->load_rate;
    Signal signal = {0.0, 0.0, stick->fixed_bound};
    Complex drive_turn = complex_rect(1.0, w * t);
    if (plant->spring != 0.0) {
        Sample sample = sample_at(stick, t, drive_turn);
        needed += plant->spring * sample.displacement + plant->damper * sample.rate;
        change += plant->spring * sample.rate + plant->damper * sample.acceleration;
        signal.bound += plant->spring * sample.acceleration_bound + plant->damper * sample.jerk_bound;
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
        Response start = stick->free_start;
        horizon = stick->horizon;
        double frequency = plant->stick.frequency, w = plant->drive_frequency;
        double rate = hypot(start.rate, frequency * start.displacement);
        double swing = complex_abs(stick->steady);
        double force = plant->spring * (rate / frequency + swing) + plant->damper * (rate + w * swing);
        reach += stick->resonates ? INFINITY : force;
        fastest = fmax(fastest, frequency);
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
    const Oscillator *oscillator = &stick->plant->stick;
    Response response = free_response(oscillator, t);
    Response free = free_motion(oscillator, stick->free_start, response);
    Complex drive_turn = complex_rect(1.0, stick->plant->drive_frequency * t);
    Response forced = forced_at(stick, t, drive_turn);
    return (State){0.0, free.displacement + forced.displacement, free.rate + forced.rate};
}
