#include "split_slide.h"

#include "../base/elementary.h"

bool split_prepare(Split *split, const Plant *plant) {
    const Oscillator *slip = &plant->slip;
    double w = plant->drive_frequency, q = plant->normal_frequency, fraction = plant->mass_fraction;
    bool follows = plant->resolves_resonator, creeps = 0.0 < fabs(q) && fabs(q) < SLOW * w;
    if (creeps) {
        return false;
    }
    if (follows && (slip->frequency < SLOW * fmax(w, fabs(q)) || resonates(slip, w) || resonates(slip, q))) {
        return false;
    }
    Complex zero = complex_of(0.0, 0.0), turn = complex_of(0.0, -1.0);
    split->merges = q == w || q == 0.0;
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
        split->work = slide_work_of(plant);
    }
    split->fastest = fmax(fmax(w, fabs(q)), slip->frequency);
    split->resonator_drive = complex_mul(turn, resonator_drive);
    split->velocity_drive = complex_mul(turn, velocity_drive);
    split->resonator_normal = complex_mul(turn, resonator_normal);
    split->velocity_normal = complex_mul(turn, velocity_normal);
    return true;
}

Phasors phasors_of(const Plant *plant, const Moment *now) {
    double chi = now->psi + plant->phase;
    double changing = plant->normal_frequency == plant->drive_frequency ? chi - now->theta : chi;
    return (Phasors){complex_rect(1.0, now->theta), complex_rect(1.0, changing)};
}

Complex normal_phasor(const Plant *plant, const Phasors *phasors) {
    return plant->normal_frequency == plant->drive_frequency ? complex_mul(phasors->drive, phasors->normal)
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

/* Angle [rad] of the fastest oscillation up to which turns are rotated: the series below are then exact to rounding. */
#define SMALL_TURN 0x1p-7

/* Whether `t` [s] is close to the start. */
static inline bool is_soon(const SplitSlide *slide, double t) {
    return t * slide->split->fastest < SMALL_TURN;
}

/* exp(i theta), without a sine at the end of a turn, where means over a period need it. */
static Complex drive_at(double theta) {
    double passed = theta - TAU;
    return fabs(passed) < 1e-9 ? complex_of(1.0, passed) : complex_rect(1.0, theta);
}

/* The free motion of the resonator at `t`. */
static void compute_free(const Plant *plant, double t, Turns *turns) {
    Complex eigenvalue = plant->slip.eigenvalue;
    turns->free = complex_of(1.0, 0.0);
    turns->envelope = 1.0;
    if (!plant->resolves_resonator) {
        return;
    }
    if (plant->slip.oscillatory) {
        turns->envelope = elementary_exp(eigenvalue.re * t);
        turns->free = complex_rect(turns->envelope, eigenvalue.im * t);
    } else {
        Response response = free_response(&plant->slip, t);
        turns->free = complex_of(response.displacement, response.rate);
    }
}

/* Turns at `t`, by sines and cosines. */
static void compute_turns(const SplitSlide *slide, double t, Turns *turns) {
    const Plant *plant = slide->plant;
    turns->t = t;
    compute_free(plant, t, turns);
    turns->phasors.drive = drive_at(slide->theta + plant->drive_frequency * t);
    turns->phasors.normal = slide->split->merges ? slide->start.phasors.normal
                                                 : complex_rect(1.0, slide->chi + plant->normal_frequency * t);
}

/* `z` exp(i angle) for a small `angle` [rad]. */
static inline Complex rotated(Complex z, double angle) {
    double square = angle * angle;
    double versed = square * (0.5 - square * (1.0 / 24.0 - square * (1.0 / 720.0)));
    double sine = angle * (1.0 - square * (1.0 / 6.0 - square * (1.0 / 120.0)));
    return complex_of(z.re - (versed * z.re + sine * z.im), z.im + (sine * z.re - versed * z.im));
}

/* exp(x) for a small `x`. */
static inline double grown(double x) {
    double tail = 1.0 / 24.0 + x * (1.0 / 120.0 + x * (1.0 / 720.0));
    return 1.0 + x * (1.0 + x * (0.5 + x * (1.0 / 6.0 + x * tail)));
}

/* Turns at the time of `anchor`, rotated to the close time `t`. */
static inline void rotate_turns(const SplitSlide *slide, const Turns *anchor, double t, Turns *turns) {
    const Plant *plant = slide->plant;
    double ahead = t - anchor->t;
    turns->t = t;
    turns->free = anchor->free;
    turns->envelope = anchor->envelope;
    if (plant->resolves_resonator && plant->slip.oscillatory) {
        Complex eigenvalue = plant->slip.eigenvalue;
        double growth = grown(eigenvalue.re * ahead);
        turns->envelope *= growth;
        turns->free = complex_scale(growth, rotated(anchor->free, eigenvalue.im * ahead));
    } else if (plant->resolves_resonator) {
        compute_free(plant, t, turns);
    }
    turns->phasors.drive = rotated(anchor->phasors.drive, plant->drive_frequency * ahead);
    turns->phasors.normal = slide->split->merges ? anchor->phasors.normal
                                                 : rotated(anchor->phasors.normal, plant->normal_frequency * ahead);
}

/* Whether turns at `t` are rotated from the start or the anchor instead of computed. Close to the start they always
 * are, so that rounding errors are those of the start: a slider that sets out must not seem to move back. */
static inline bool is_near(const SplitSlide *slide, double t) {
    return is_soon(slide, t) || (slide->anchored && fabs(t - slide->anchor.t) * slide->split->fastest < SMALL_TURN);
}

/* The turns at `t`: those of the start, or others, which are put in `place`. */
static inline const Turns *turns_at(const SplitSlide *slide, double t, Turns *place) {
    if (t == 0.0) {
        return &slide->start;
    }
    if (is_near(slide, t)) {
        rotate_turns(slide, is_soon(slide, t) ? &slide->start : &slide->anchor, t, place);
    } else {
        compute_turns(slide, t, place);
    }
    return place;
}

/* Free motion of the resonator, its displacement [m] and rate [m/s]. */
static inline Response free_motion_at(const SplitSlide *slide, const Turns *turns) {
    const Oscillator *slip = &slide->plant->slip;
    if (!slip->oscillatory) {
        return free_motion(slip, slide->free_start, (Response){turns->free.re, turns->free.im});
    }
    Complex swing = complex_mul(slide->resonator_free, turns->free);
    return (Response){swing.re, slip->eigenvalue.re * swing.re - slip->eigenvalue.im * swing.im};
}

/* Sets the complex amplitude of the free oscillation of the resonator [m] and returns the velocity amplitude of the
 * slider that belongs to it [m/s]. */
static double swing_freely(SplitSlide *slide, Complex free) {
    const Plant *plant = slide->plant;
    double decaying = plant->mass_fraction * plant->slip.frequency * complex_abs(free);
    slide->resonator_free = free;
    slide->free_start.displacement = free.re;
    slide->free_bound = decaying * plant->slip.stiffness;
    return decaying;
}

/* Sets the free motion of the resonator, from displacement [m] and rate [m/s] on; returns the velocity of the slider
 * that belongs to it at most [m/s]. */
static double begin_freely(SplitSlide *slide, Response free) {
    const Plant *plant = slide->plant;
    Complex eigenvalue = plant->slip.eigenvalue;
    slide->free_start = free;
    slide->free_bound = 0.0;
    if (plant->slip.oscillatory) {
        double quarter = (free.rate - eigenvalue.re * free.displacement) / eigenvalue.im;
        return swing_freely(slide, complex_of(free.displacement, -quarter));
    }
    return plant->mass_fraction * hypot(free.rate, plant->slip.frequency * free.displacement);
}

/* Sets the free part and the bounds of a slide whose forced parts are known, so that it begins at `state`. */
static void match_state(SplitSlide *slide, const State *state) {
    const Plant *plant = slide->plant;
    double w = plant->drive_frequency, q = plant->normal_frequency;
    const Phasors *start = &slide->start.phasors;
    Complex ae = complex_mul(slide->resonator_drive, start->drive), aq = complex_of(0.0, 0.0);
    double forced = complex_mul(slide->velocity_drive, start->drive).re, normal = 0.0;
    double bound = 0.0;
    if (!slide->split->merges) {
        aq = complex_mul(slide->resonator_normal, start->normal);
        normal = complex_abs(slide->velocity_normal);
        forced += complex_mul(slide->velocity_normal, start->normal).re;
        bound = normal * q * q;
    }
    Response free = {0.0, 0.0};
    if (plant->resolves_resonator) {
        free.displacement = state->displacement - slide->constant - (ae.re + aq.re);
        free.rate = state->rate + w * ae.im + q * aq.im - slide->slope;
    }
    double decaying = begin_freely(slide, free), drive = complex_abs(slide->velocity_drive);
    slide->k0 = state->velocity - forced + plant->mass_fraction * free.rate;
    slide->bound = drive * w * w + bound + 2.0 * fabs(slide->k2);
    slide->noise = 2.0 * EPSILON * (fabs(slide->k0) + drive + normal + decaying);
}

void split_slide_begin(SplitSlide *slide, const Split *split, const Plant *plant, const Moment *now,
                       const Phasors *start, int direction) {
    int sign = now->mode == LIFTED ? 0 : direction;
    double friction = sign * plant->friction_preload;
    slide->split = split;
    slide->plant = plant;
    slide->direction = direction;
    slide->sign = sign;
    slide->works = false;
    slide->begin = now->state;
    slide->theta = now->theta;
    slide->chi = now->psi + plant->phase;
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
    match_state(slide, &now->state);
}

void split_slide_change(SplitSlide *slide, double momentum, Complex swing) {
    Complex rate = complex_mul(slide->plant->slip.eigenvalue, swing);
    slide->begin.velocity += momentum - slide->plant->mass_fraction * rate.re;
    slide->begin.displacement += swing.re;
    slide->begin.rate += rate.re;
    slide->k0 += momentum;
    double decaying = swing_freely(slide, complex_add(slide->resonator_free, swing));
    slide->noise += 2.0 * EPSILON * (fabs(momentum) + decaying);
}

void split_slide_anchor(SplitSlide *slide, double t, Complex drive, Complex normal, Complex free) {
    const Phasors *start = &slide->start.phasors;
    bool resolves = slide->plant->resolves_resonator;
    slide->anchor.t = t;
    slide->anchor.phasors.drive = complex_mul(start->drive, drive);
    slide->anchor.phasors.normal = slide->split->merges ? start->normal : complex_mul(start->normal, normal);
    slide->anchor.free = resolves ? free : complex_of(1.0, 0.0);
    slide->anchor.envelope = resolves ? complex_abs(free) : 1.0;
    slide->anchored = true;
}

static inline double velocity_by(const SplitSlide *slide, const Turns *turns, double rate) {
    double t = turns->t;
    double velocity = slide->k0 + (slide->k1 + slide->k2 * t) * t +
                      complex_mul(slide->velocity_drive, turns->phasors.drive).re - slide->plant->mass_fraction * rate;
    if (slide->split->merges) {
        return velocity;
    }
    return velocity + complex_mul(slide->velocity_normal, turns->phasors.normal).re;
}

static inline double acceleration_by(const SplitSlide *slide, const Turns *turns, double acceleration) {
    const Plant *plant = slide->plant;
    Complex drive = complex_mul(slide->velocity_drive, turns->phasors.drive);
    double total = slide->k1 + 2.0 * slide->k2 * turns->t - plant->drive_frequency * drive.im -
                   plant->mass_fraction * acceleration;
    if (!slide->split->merges) {
        Complex normal = complex_mul(slide->velocity_normal, turns->phasors.normal);
        total -= plant->normal_frequency * normal.im;
    }
    return total;
}

/* Bound [m/s^3] on the second derivative of the velocity from turns on. That by the free motion is bounded by its
 * energy, which never grows. */
static inline double bound_by(const SplitSlide *slide, const Turns *turns, double rate, double acceleration) {
    const Oscillator *slip = &slide->plant->slip;
    if (slip->oscillatory) {
        return slide->bound + slide->free_bound * turns->envelope;
    }
    double jerk = -2.0 * slip->decay * acceleration - slip->stiffness * rate;
    return slide->bound + slide->plant->mass_fraction * hypot(jerk, slip->frequency * acceleration);
}

static Signal velocity_ahead(void *motion, double t) {
    SplitSlide *slide = motion;
    const Oscillator *slip = &slide->plant->slip;
    bool is_latest = !is_near(slide, t) && (!slide->anchored || t > slide->anchor.t);
    if (is_latest) {
        compute_turns(slide, t, &slide->anchor);
        slide->anchored = true;
    }
    Turns place;
    const Turns *turns = is_latest ? &slide->anchor : turns_at(slide, t, &place);
    Response free = free_motion_at(slide, turns);
    double second = -2.0 * slip->decay * free.rate - slip->stiffness * free.displacement;
    return (Signal){slide->direction * velocity_by(slide, turns, free.rate),
                    slide->direction * acceleration_by(slide, turns, second),
                    bound_by(slide, turns, free.rate, second)};
}

Watch split_slide_watch(SplitSlide *slide) {
    return (Watch){velocity_ahead, slide, slide->noise, slide->split->fastest};
}

/* Integral of the real part of amplitude exp(i frequency s), between turns `start` and `end`; frequency != 0. */
static double swing_travel(Complex amplitude, double frequency, Complex start, Complex end) {
    return complex_mul(amplitude, complex_sub(end, start)).im / frequency;
}

static inline double travel_by(const SplitSlide *slide, const Turns *turns, double displacement) {
    const Plant *plant = slide->plant;
    double t = turns->t, moved = displacement - slide->free_start.displacement;
    double travel =
        swing_travel(slide->velocity_drive, plant->drive_frequency, slide->start.phasors.drive, turns->phasors.drive) -
        plant->mass_fraction * moved;
    if (!slide->split->merges) {
        travel += swing_travel(slide->velocity_normal, plant->normal_frequency, slide->start.phasors.normal,
                               turns->phasors.normal);
    }
    return (slide->k0 + (0.5 * slide->k1 + slide->k2 * t / 3.0) * t) * t + travel;
}

static SlideEnd end_by(const Plant *plant, const Turns *turns, State state) {
    return (SlideEnd){turns->phasors.drive, normal_phasor(plant, &turns->phasors), state};
}

/* Work of friction [J] up to turns, where the displacement [m] and the state are known. */
static double work_by(const SplitSlide *slide, const Turns *turns, State state, double travelled) {
    const Plant *plant = slide->plant;
    if (!slide->works) {
        return 0.0;
    }
    double swung;
    if (plant->normal_frequency == 0.0) {
        swung = slide->start.phasors.normal.im * travelled;
    } else {
        SlideEnd first = end_by(plant, &slide->start, slide->begin), last = end_by(plant, turns, state);
        swung = slide_work_swung(&slide->split->work, plant, slide->sign, turns->t, &first, &last);
    }
    return slide->sign * (plant->friction_preload * travelled + plant->friction_amplitude * swung);
}

Place split_slide_place(const SplitSlide *slide, double t) {
    const Plant *plant = slide->plant;
    Turns place;
    const Turns *turns = turns_at(slide, t, &place);
    Response free = free_motion_at(slide, turns);
    Complex ae = complex_mul(slide->resonator_drive, turns->phasors.drive);
    State state = {velocity_by(slide, turns, free.rate), slide->constant + slide->slope * t + ae.re + free.displacement,
                   slide->slope - plant->drive_frequency * ae.im + free.rate};
    if (!slide->split->merges) {
        Complex aq = complex_mul(slide->resonator_normal, turns->phasors.normal);
        state.displacement += aq.re;
        state.rate -= plant->normal_frequency * aq.im;
    }
    double travel = travel_by(slide, turns, free.displacement);
    Passage passed = {travel, work_by(slide, turns, state, travel)};
    return (Place){state, passed, {!is_soon(slide, t), turns->phasors}};
}
