#include "split_slide.h"

#include <math.h>

bool split_prepare(Split *split, const Plant *plant) {
    const Oscillator *slip = &plant->slip;
    double w = plant->drive_frequency, q = plant->normal_frequency, fraction = plant->mass_fraction;
    bool follows = plant->resolves_resonator;
    if (!slip->oscillatory || (0.0 < fabs(q) && fabs(q) < SLOW * w)) {
        return false;
    }
    if (follows && (slip->frequency < SLOW * fmax(w, fabs(q)) || resonates(slip, w) ||
                    resonates(slip, q))) {
        return false;
    }
    Complex zero = complex_of(0.0, 0.0), turn = complex_of(0.0, -1.0);
    Complex resonator_drive = zero, resonator_normal = zero, velocity_normal = zero;
    if (follows) {
        resonator_drive = complex_scale(plant->relative_drive, transfer(slip, w));
    }
    Complex pull = complex_scale(fraction * w * w, resonator_drive);
    Complex velocity_drive = complex_div(complex_add(plant->drive, pull), complex_of(0.0, w));
    if (q != 0.0) {
        if (follows) {
            double push = plant->friction_amplitude / plant->slider_mass;
            resonator_normal = complex_scale(push, transfer(slip, q));
        }
        Complex resisting = complex_scale(fraction * q * q, resonator_normal);
        resisting.re -= plant->friction_amplitude / plant->total_mass;
        velocity_normal = complex_div(resisting, complex_of(0.0, q));
    }
    split->merges = q == w || q == 0.0;
    split->fastest = fmax(fmax(w, fabs(q)), complex_abs(slip->eigenvalue));
    split->resonator_drive = complex_mul(turn, resonator_drive);
    split->velocity_drive = complex_mul(turn, velocity_drive);
    split->resonator_normal = complex_mul(turn, resonator_normal);
    split->velocity_normal = complex_mul(turn, velocity_normal);
    return true;
}

/* Amplitudes and bounds of a slide whose forced parts are known, from `state` on. */
static void match_state(SplitSlide *slide, const State *state) {
    const Plant *plant = slide->plant;
    double w = plant->drive_frequency, q = plant->normal_frequency;
    Complex ae = slide->resonator_drive, aq = slide->resonator_normal;
    Complex free = complex_of(0.0, 0.0);
    if (plant->resolves_resonator) {
        Complex eigenvalue = plant->slip.eigenvalue;
        double displacement = state->displacement - slide->constant - (ae.re + aq.re);
        double rate = state->rate + w * ae.im + q * aq.im;
        free = complex_of(displacement, -(rate - eigenvalue.re * displacement) / eigenvalue.im);
    }
    Complex turning = complex_mul(plant->slip.eigenvalue, free);
    slide->resonator_free = free;
    slide->velocity_free = complex_scale(-plant->mass_fraction, turning);
    slide->travel_free = complex_scale(-plant->mass_fraction, free);
    slide->k0 = state->velocity - (slide->velocity_drive.re + slide->velocity_normal.re +
                                   slide->velocity_free.re);
    double drive = complex_abs(slide->velocity_drive), normal = complex_abs(slide->velocity_normal);
    double decaying = complex_abs(slide->velocity_free);
    slide->bound = drive * w * w + normal * q * q;
    slide->free_bound = decaying * plant->slip.stiffness;
    slide->noise = 2.0 * EPSILON * (fabs(slide->k0) + drive + normal + decaying);
}

void split_slide_begin(SplitSlide *slide, const Split *split, const Plant *plant, int sign,
                       const State *state, double theta, double chi, int direction) {
    Complex drive_turn = complex_rect(1.0, theta), zero = complex_of(0.0, 0.0);
    double friction = sign * plant->friction_preload, normal_sine = sin(chi);
    Complex normal_turn = complex_of(sign * cos(chi), sign * normal_sine);
    if (plant->normal_frequency == 0.0) {
        friction += sign * plant->friction_amplitude * normal_sine;
        normal_turn = zero;
    }
    slide->split = split;
    slide->plant = plant;
    slide->direction = direction;
    slide->constant = (friction + plant->load) / (plant->slider_mass * plant->slip.stiffness);
    slide->k1 = -(friction + plant->load) / plant->total_mass;
    slide->resonator_drive = complex_mul(split->resonator_drive, drive_turn);
    slide->resonator_normal = complex_mul(split->resonator_normal, normal_turn);
    slide->velocity_drive = complex_mul(split->velocity_drive, drive_turn);
    slide->velocity_normal = complex_mul(split->velocity_normal, normal_turn);
    if (split->merges) {
        slide->resonator_drive = complex_add(slide->resonator_drive, slide->resonator_normal);
        slide->velocity_drive = complex_add(slide->velocity_drive, slide->velocity_normal);
        slide->resonator_normal = slide->velocity_normal = zero;
    }
    match_state(slide, state);
}

/* exp(i w t), exp(i q t), exp(lambda t) and |exp(lambda t)|; 1 where no resonator swings freely. */
typedef struct {
    Complex drive, normal, free;
    double envelope;
} Turns;

static inline Turns turns_at(const SplitSlide *slide, double t) {
    const Plant *plant = slide->plant;
    Complex eigenvalue = plant->slip.eigenvalue;
    Complex one = complex_of(1.0, 0.0);
    Turns turns = {one, one, one, 1.0};
    if (t == 0.0) {
        return turns;
    }
    if (plant->resolves_resonator) {
        turns.envelope = exp(eigenvalue.re * t);
        turns.free = complex_rect(turns.envelope, eigenvalue.im * t);
    }
    turns.drive = complex_rect(1.0, plant->drive_frequency * t);
    turns.normal = slide->split->merges ? turns.drive
                                        : complex_rect(1.0, plant->normal_frequency * t);
    return turns;
}

static Signal velocity_ahead(const void *motion, double t) {
    const SplitSlide *slide = motion;
    const Plant *plant = slide->plant;
    Complex eigenvalue = plant->slip.eigenvalue;
    Turns turns = turns_at(slide, t);
    Complex e = complex_mul(slide->velocity_drive, turns.drive);
    Complex h = complex_mul(slide->velocity_free, turns.free);
    double velocity = slide->k0 + slide->k1 * t + e.re + h.re;
    double acceleration = slide->k1 - plant->drive_frequency * e.im + eigenvalue.re * h.re -
                          eigenvalue.im * h.im;
    if (!slide->split->merges) {
        Complex n = complex_mul(slide->velocity_normal, turns.normal);
        velocity += n.re;
        acceleration -= plant->normal_frequency * n.im;
    }
    return (Signal){slide->direction * velocity, slide->direction * acceleration,
                    slide->bound + slide->free_bound * turns.envelope};
}

Watch split_slide_watch(const SplitSlide *slide) {
    return (Watch){velocity_ahead, slide, slide->noise, slide->split->fastest, INFINITY};
}

/* Integral of the real part of amplitude exp(i frequency s) from turn 1 on, frequency != 0. */
static double swing_travel(Complex amplitude, double frequency, Complex turn) {
    turn.re -= 1.0;
    return complex_mul(amplitude, turn).im / frequency;
}

static inline double travel_by(const SplitSlide *slide, double t, Turns turns) {
    const Plant *plant = slide->plant;
    Complex free = complex_of(turns.free.re - 1.0, turns.free.im);
    double travel = complex_mul(slide->travel_free, free).re;
    travel += swing_travel(slide->velocity_drive, plant->drive_frequency, turns.drive);
    if (!slide->split->merges) {
        travel += swing_travel(slide->velocity_normal, plant->normal_frequency, turns.normal);
    }
    return (slide->k0 + 0.5 * slide->k1 * t) * t + travel;
}

static inline State state_by(const SplitSlide *slide, double t, Turns turns) {
    const Plant *plant = slide->plant;
    Complex eigenvalue = plant->slip.eigenvalue;
    Complex ae = complex_mul(slide->resonator_drive, turns.drive);
    Complex ah = complex_mul(slide->resonator_free, turns.free);
    State state;
    state.velocity = slide->k0 + slide->k1 * t +
                     complex_mul(slide->velocity_drive, turns.drive).re +
                     complex_mul(slide->velocity_free, turns.free).re;
    state.displacement = slide->constant + ae.re + ah.re;
    state.rate = eigenvalue.re * ah.re - eigenvalue.im * ah.im - plant->drive_frequency * ae.im;
    if (!slide->split->merges) {
        Complex aq = complex_mul(slide->resonator_normal, turns.normal);
        state.velocity += complex_mul(slide->velocity_normal, turns.normal).re;
        state.displacement += aq.re;
        state.rate -= plant->normal_frequency * aq.im;
    }
    return state;
}

double split_slide_travel(const SplitSlide *slide, double t) {
    return travel_by(slide, t, turns_at(slide, t));
}

State split_slide_end(const SplitSlide *slide, double t, double *travel) {
    Turns turns = turns_at(slide, t);
    *travel = travel_by(slide, t, turns);
    return state_by(slide, t, turns);
}
