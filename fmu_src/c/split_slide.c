#include "split_slide.h"

#include "elementary.h"

#include "split_turns.h"

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

Phasors phasors_of(const Plant *plant, double theta, double chi) {
    double changing = plant->normal_frequency == plant->drive_frequency ? chi - theta : chi;
    return (Phasors){complex_rect(1.0, theta), complex_rect(1.0, changing)};
}

Complex normal_phasor(const Plant *plant, const Phasors *phasors) {
    return plant->normal_frequency == plant->drive_frequency
               ? complex_mul(phasors->drive, phasors->normal)
               : phasors->normal;
}

double force_by(const Plant *plant, const State *state, const Phasors *phasors) {
    double direct = complex_mul(plant->holding_drive, phasors->drive).im;
    return plant->spring * state->displacement + plant->damper * state->rate - plant->load + direct;
}

double friction_limit_by(const Plant *plant, const Phasors *phasors) {
    double sine = normal_phasor(plant, phasors).im;
    double limit = plant->friction_preload + plant->friction_amplitude * sine;
    return limit > 0.0 ? limit : 0.0;
}

/* Sets the complex amplitude of the free oscillation of the resonator [m] and returns the velocity amplitude
 * of the slider that belongs to it [m/s]. */
static double swing_freely(SplitSlide *slide, Complex free) {
    const Plant *plant = slide->plant;
    Complex turning = complex_mul(plant->slip.eigenvalue, free);
    slide->resonator_free = free;
    slide->velocity_free = complex_scale(-plant->mass_fraction, turning);
    slide->travel_free = complex_scale(-plant->mass_fraction, free);
    double decaying = plant->resolves_resonator ? complex_abs(slide->velocity_free) : 0.0;
    slide->free_bound = decaying * plant->slip.stiffness;
    return decaying;
}

/* Sets the free part and the bounds of a slide whose forced parts are known, so that it begins at `state`. */
static void match_state(SplitSlide *slide, const State *state) {
    const Plant *plant = slide->plant;
    double w = plant->drive_frequency, q = plant->normal_frequency;
    const Phasors *start = &slide->start.phasors;
    Complex ae = complex_mul(slide->resonator_drive, start->drive), aq = complex_of(0.0, 0.0);
    double forced = complex_mul(slide->velocity_drive, start->drive).re, normal = 0.0;
    if (!slide->split->merges) {
        aq = complex_mul(slide->resonator_normal, start->normal);
        forced += complex_mul(slide->velocity_normal, start->normal).re;
        normal = complex_abs(slide->velocity_normal);
    }
    Complex free = complex_of(0.0, 0.0);
    if (plant->resolves_resonator) {
        Complex eigenvalue = plant->slip.eigenvalue;
        double displacement = state->displacement - slide->constant - (ae.re + aq.re);
        double rate = state->rate + w * ae.im + q * aq.im - slide->slope;
        free = complex_of(displacement, -(rate - eigenvalue.re * displacement) / eigenvalue.im);
    }
    double decaying = swing_freely(slide, free), drive = complex_abs(slide->velocity_drive);
    slide->k0 = state->velocity - (forced + slide->velocity_free.re);
    slide->bound = drive * w * w + normal * q * q + 2.0 * fabs(slide->k2);
    slide->noise = 2.0 * EPSILON * (fabs(slide->k0) + drive + normal + decaying);
}

void split_slide_begin(SplitSlide *slide, const Split *split, const Plant *plant, int sign,
                       const State *state, double theta, double chi, const Phasors *start,
                       int direction) {
    double friction = sign * plant->friction_preload;
    slide->split = split;
    slide->plant = plant;
    slide->direction = direction;
    slide->theta = theta;
    slide->chi = chi;
    slide->start.t = 0.0;
    slide->start.phasors = *start;
    slide->start.free = complex_of(1.0, 0.0);
    slide->start.envelope = 1.0;
    slide->anchored = false;
    slide->resonator_drive = split->resonator_drive;
    slide->velocity_drive = split->velocity_drive;
    slide->resonator_normal = complex_scale(sign, split->resonator_normal);
    slide->velocity_normal = complex_scale(sign, split->velocity_normal);
    if (plant->normal_frequency == 0.0) {
        friction += sign * plant->friction_amplitude * start->normal.im;
    } else if (split->merges) {
        Complex resonator = complex_mul(slide->resonator_normal, start->normal);
        Complex velocity = complex_mul(slide->velocity_normal, start->normal);
        slide->resonator_drive = complex_add(slide->resonator_drive, resonator);
        slide->velocity_drive = complex_add(slide->velocity_drive, velocity);
    }
    slide->slope = plant->load_rate / (plant->slider_mass * plant->slip.stiffness);
    slide->constant = (friction + plant->load) / (plant->slider_mass * plant->slip.stiffness) -
                      2.0 * plant->slip.decay / plant->slip.stiffness * slide->slope;
    slide->k1 = -(friction + plant->load) / plant->total_mass;
    slide->k2 = -0.5 * plant->load_rate / plant->total_mass;
    match_state(slide, state);
}

void split_slide_change(SplitSlide *slide, double momentum, Complex swing) {
    slide->k0 += momentum;
    double decaying = swing_freely(slide, complex_add(slide->resonator_free, swing));
    slide->noise += 2.0 * EPSILON * (fabs(momentum) + decaying);
}

void split_slide_anchor(SplitSlide *slide, double t, Complex drive, Complex normal, Complex free) {
    const Phasors *start = &slide->start.phasors;
    bool resolves = slide->plant->resolves_resonator;
    slide->anchor.t = t;
    slide->anchor.phasors.drive = complex_mul(start->drive, drive);
    slide->anchor.phasors.normal =
        slide->split->merges ? start->normal : complex_mul(start->normal, normal);
    slide->anchor.free = resolves ? free : complex_of(1.0, 0.0);
    slide->anchor.envelope = resolves ? complex_abs(free) : 1.0;
    slide->anchored = true;
}

static Signal velocity_ahead(void *motion, double t) {
    SplitSlide *slide = motion;
    const Plant *plant = slide->plant;
    Complex eigenvalue = plant->slip.eigenvalue;
    Turns place;
    bool later = !slide->anchored || t > slide->anchor.t;
    const Turns *turns = turns_at(slide, t, &place, later ? &slide->anchor : &place);
    slide->anchored = slide->anchored || turns == &slide->anchor;
    Complex e = complex_mul(slide->velocity_drive, turns->phasors.drive);
    Complex h = complex_mul(slide->velocity_free, turns->free);
    double velocity = slide->k0 + (slide->k1 + slide->k2 * t) * t + e.re + h.re;
    double acceleration = slide->k1 + 2.0 * slide->k2 * t - plant->drive_frequency * e.im +
                          eigenvalue.re * h.re - eigenvalue.im * h.im;
    if (!slide->split->merges) {
        Complex n = complex_mul(slide->velocity_normal, turns->phasors.normal);
        velocity += n.re;
        acceleration -= plant->normal_frequency * n.im;
    }
    return (Signal){slide->direction * velocity, slide->direction * acceleration,
                    slide->bound + slide->free_bound * turns->envelope};
}

Watch split_slide_watch(SplitSlide *slide) {
    return (Watch){velocity_ahead, slide, slide->noise, slide->split->fastest, INFINITY};
}

/* Integral of the real part of amplitude exp(i frequency s), between turns `start` and `end`;
 * frequency != 0. */
static double swing_travel(Complex amplitude, double frequency, Complex start, Complex end) {
    return complex_mul(amplitude, complex_sub(end, start)).im / frequency;
}

static inline double travel_by(const SplitSlide *slide, double t, const Turns *turns) {
    const Plant *plant = slide->plant;
    const Phasors *start = &slide->start.phasors, *end = &turns->phasors;
    Complex free = complex_of(turns->free.re - 1.0, turns->free.im);
    double travel = complex_mul(slide->travel_free, free).re;
    travel += swing_travel(slide->velocity_drive, plant->drive_frequency, start->drive, end->drive);
    if (!slide->split->merges) {
        travel += swing_travel(slide->velocity_normal, plant->normal_frequency, start->normal,
                               end->normal);
    }
    return (slide->k0 + (0.5 * slide->k1 + slide->k2 * t / 3.0) * t) * t + travel;
}

static inline State state_by(const SplitSlide *slide, double t, const Turns *turns) {
    const Plant *plant = slide->plant;
    Complex eigenvalue = plant->slip.eigenvalue;
    Complex ae = complex_mul(slide->resonator_drive, turns->phasors.drive);
    Complex ah = complex_mul(slide->resonator_free, turns->free);
    State state;
    state.velocity = slide->k0 + (slide->k1 + slide->k2 * t) * t +
                     complex_mul(slide->velocity_drive, turns->phasors.drive).re +
                     complex_mul(slide->velocity_free, turns->free).re;
    state.displacement = slide->constant + slide->slope * t + ae.re + ah.re;
    state.rate = eigenvalue.re * ah.re - eigenvalue.im * ah.im - plant->drive_frequency * ae.im +
                 slide->slope;
    if (!slide->split->merges) {
        Complex aq = complex_mul(slide->resonator_normal, turns->phasors.normal);
        state.velocity += complex_mul(slide->velocity_normal, turns->phasors.normal).re;
        state.displacement += aq.re;
        state.rate -= plant->normal_frequency * aq.im;
    }
    return state;
}

double split_slide_travel(const SplitSlide *slide, double t) {
    Turns place;
    return travel_by(slide, t, turns_at(slide, t, &place, &place));
}

State split_slide_end(const SplitSlide *slide, double t, double *travel, KnownPhasors *known) {
    Turns place;
    const Turns *turns = turns_at(slide, t, &place, &place);
    *travel = travel_by(slide, t, turns);
    *known = (KnownPhasors){!is_soon(slide, t), turns->phasors};
    return state_by(slide, t, turns);
}
