#include "vibrating_load.h"

#include "../base/elementary.h"

static double in_turn(const VibratingLoad *load, double angle) {
    return load->preload * angle + load->amplitude * (load->cos_dip - cos(angle - load->dip));
}

/* Integral of N over its own phase, from the touchdown at -dip up to `chi`. */
static double up_to(const VibratingLoad *load, double chi) {
    double turns = floor((chi + load->dip) / TAU);
    double within = chi + load->dip - turns * TAU, touching = PI + 2.0 * load->dip;
    within = within > touching ? touching : within;
    return turns * load->per_turn + in_turn(load, within);
}

static double in_contact(const VibratingLoad *load, double chi) {
    double normal = load->preload + load->amplitude * sin(chi);
    return normal > 0.0 ? normal : 0.0;
}

int max_turns_to_repeat(const Device *device) {
    return device->normal_amplitude > device->normal_preload ? MAX_TURNS_TO_REPEAT : 1;
}

int turns_to_repeat(double ratio, int max_turns, double near) {
    for (int turns = 1; turns <= max_turns; turns++) {
        if (fabs(turns * ratio - nearbyint(turns * ratio)) <= fmax(near / turns, EXACT)) {
            return turns;
        }
    }
    return 0;
}

/* The phase of the load in one of its turns [rad]. */
static double delta_in(const VibratingLoad *load, int turn) {
    return load->delta + load->ratio * TAU * turn;
}

/* Whether the load is constant over a turn, at a ratio of rounding: integrals below would lose their digits to 1 /
 * n. */
static bool stands(const VibratingLoad *load) {
    return fabs(load->ratio) <= EXACT;
}

VibratingLoad vibrating_load_of(const Device *device, double ratio, double delta) {
    VibratingLoad load = {0};
    load.preload = device->normal_preload;
    load.amplitude = device->normal_amplitude;
    load.ratio = ratio;
    load.delta = delta;
    load.sine = sin(delta);
    load.dip = vibrating_load_lifts(&load) ? asin(load.preload / load.amplitude) : 0.5 * PI;
    load.cos_dip = cos(load.dip);
    load.per_turn = in_turn(&load, PI + 2.0 * load.dip);
    load.turns = turns_to_repeat(ratio, max_turns_to_repeat(device), 0.0);
    load.is_constant = stands(&load) || load.turns == 0;
    load.constant = stands(&load) ? in_contact(&load, delta) : load.per_turn / TAU;
    return load;
}

VibratingLoad vibrating_load_turned(const VibratingLoad *load, double angle) {
    VibratingLoad turned = *load;
    turned.delta += angle;
    turned.sine = sin(turned.delta);
    turned.constant = stands(load) ? in_contact(load, turned.delta) : load->constant;
    return turned;
}

VibratingLoad vibrating_load_flattened(const VibratingLoad *load) {
    VibratingLoad flat = *load;
    flat.is_constant = true;
    flat.constant = load->per_turn / TAU;
    return flat;
}

double vibrating_load_next_kink(const VibratingLoad *load, double angle) {
    if (load->is_constant || !vibrating_load_lifts(load)) {
        return INFINITY;
    }
    double n = load->ratio, kinks[] = {-load->dip, PI + load->dip}, next = INFINITY;
    for (int i = 0; i < 2 * load->turns; i++) {
        double delta = delta_in(load, i / 2), turns = (n * angle + delta - kinks[i % 2]) / TAU;
        turns = n > 0.0 ? floor(turns) + 1.0 : ceil(turns) - 1.0;
        double kink = (kinks[i % 2] + TAU * turns - delta) / n;
        next = fmin(next, kink > angle ? kink : kink + TAU / fabs(n));
    }
    return next;
}

double vibrating_load_at(const VibratingLoad *load, double angle) {
    if (load->is_constant) {
        return load->constant;
    }
    double sum = 0.0;
    for (int turn = 0; turn < load->turns; turn++) {
        sum += in_contact(load, load->ratio * angle + delta_in(load, turn));
    }
    return sum / load->turns;
}

double vibrating_load_difference(const VibratingLoad *load, double turning) {
    if (load->is_constant) {
        return load->constant * (TAU - turning - turning) - load->constant * (turning + turning);
    }
    double n = load->ratio, forward = 0.0, backward = 0.0;
    if (!vibrating_load_lifts(load)) {
        double swung = 4.0 * load->amplitude / n * sin(n * turning) * load->sine;
        return load->preload * (TAU - 4.0 * turning) - swung;
    }
    for (int turn = 0; turn < load->turns; turn++) {
        double delta = delta_in(load, turn), middle = up_to(load, n * turning + delta);
        forward += up_to(load, n * (TAU - turning) + delta) - middle;
        backward += middle - up_to(load, n * -turning + delta);
    }
    return forward / (n * load->turns) - backward / (n * load->turns);
}
