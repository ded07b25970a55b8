#include "split_slide.h"

#include "../base/elementary.h"

/* Share of the drive frequency below which the ends of a phasor differ too little to integrate it by them. */
#define STANDING 1e-3

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
    Complex zero = complex_of(0.0, 0.0), turn = complex_of(0.0, -1.0), resonator_normal = zero, velocity_normal = zero;
    Complex to_drive = follows ? transfer(slip, w) : zero, to_normal = follows ? transfer(slip, q) : zero;
    Complex resonator_drive = complex_scale(plant->relative_drive, to_drive);
    Complex pull = complex_scale(fraction * w * w, resonator_drive);
    Complex velocity_drive = complex_div(complex_add(plant->drive, pull), complex_of(0.0, w));
    if (q != 0.0) {
        resonator_normal = complex_scale(plant->friction_amplitude / plant->slider_mass, to_normal);
        Complex resisting = complex_scale(fraction * q * q, resonator_normal);
        resisting.re -= plant->friction_amplitude / plant->total_mass;
        velocity_normal = complex_div(resisting, complex_of(0.0, q));
    }
    for (int i = 0; i < 2; i++) {
        double frequency = i == 0 ? q + w : q - w, least = STANDING * w;
        double half = 0.5 / fmax(fabs(frequency), least); /* compilers divide where nothing swings, too */
        split->frequency[i] = frequency;
        split->integral[i] = fabs(frequency) > least ? copysign(half, -frequency) : 0.0;
    }
    split->merges = q == w || q == 0.0;
    split->recoil = complex_scale(fraction, complex_conj(to_normal));
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

/* The free motion of the resonator at `t`, as in Turns. */
static Complex free_at(const Plant *plant, double t) {
    Complex eigenvalue = plant->slip.eigenvalue;
    if (!plant->resolves_resonator) {
        return complex_of(1.0, 0.0);
    }
    if (plant->slip.oscillatory) {
        return complex_rect(elementary_exp(eigenvalue.re * t), eigenvalue.im * t);
    }
    Response response = free_response(&plant->slip, t);
    return complex_of(response.displacement, response.rate);
}

/* Turns at `t`, by sines and cosines. */
static void compute_turns(const SplitSlide *slide, double t, Turns *turns) {
    const Plant *plant = slide->plant;
    turns->t = t;
    turns->free = free_at(plant, t);
    turns->phasors.drive = complex_rect(1.0, slide->theta + plant->drive_frequency * t);
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
    if (plant->resolves_resonator && plant->slip.oscillatory) {
        Complex eigenvalue = plant->slip.eigenvalue;
        turns->free = complex_scale(grown(eigenvalue.re * ahead), rotated(anchor->free, eigenvalue.im * ahead));
    } else {
        turns->free = free_at(plant, t);
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
    double sine = slip->oscillatory ? turns->free.im / slip->eigenvalue.im : turns->free.im;
    return free_motion(slip, slide->free_start, (Response){turns->free.re, sine});
}

/* Velocity of the slider [m/s] that belongs to the free motion at most. */
static double free_velocity(const SplitSlide *slide) {
    const Plant *plant = slide->plant;
    return plant->mass_fraction * hypot(slide->free_start.rate, plant->slip.frequency * slide->free_start.displacement);
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
    slide->free_start = free;
    double drive = complex_abs(slide->velocity_drive);
    slide->k0 = state->velocity - forced + plant->mass_fraction * free.rate;
    slide->bound = drive * w * w + bound + 2.0 * fabs(slide->k2);
    slide->noise = 2.0 * EPSILON * (fabs(slide->k0) + drive + normal + free_velocity(slide));
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
    slide->theta = now->theta;
    slide->chi = now->psi + plant->phase;
    slide->start = (Turns){0.0, *start, {1.0, 0.0}};
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
    slide->k0 += momentum;
    slide->free_start.displacement += swing.re;
    slide->free_start.rate += rate.re;
    slide->noise += 2.0 * EPSILON * (fabs(momentum) + free_velocity(slide));
}

void split_slide_anchor(SplitSlide *slide, double t, Complex drive, Complex normal, Complex free) {
    const Phasors *start = &slide->start.phasors;
    slide->anchor.t = t;
    slide->anchor.phasors.drive = complex_mul(start->drive, drive);
    slide->anchor.phasors.normal = slide->split->merges ? start->normal : complex_mul(start->normal, normal);
    slide->anchor.free = slide->plant->resolves_resonator ? free : complex_of(1.0, 0.0);
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
static inline double bound_by(const SplitSlide *slide, double rate, double acceleration) {
    const Oscillator *slip = &slide->plant->slip;
    double jerk = -2.0 * slip->decay * acceleration - slip->stiffness * rate;
    return slide->bound + slide->plant->mass_fraction * hypot(jerk, slip->frequency * acceleration);
}

double split_slide_departure(const SplitSlide *slide) {
    const Plant *plant = slide->plant;
    double decay = plant->slip.decay, stiffness = plant->slip.stiffness, rate = slide->free_start.rate;
    double second = -2.0 * decay * rate - stiffness * slide->free_start.displacement;
    double third = -2.0 * decay * second - stiffness * rate, fourth = -2.0 * decay * third - stiffness * second;
    double w = plant->drive_frequency, q = slide->split->merges ? 0.0 : plant->normal_frequency;
    Complex drive = complex_mul(slide->velocity_drive, slide->start.phasors.drive);
    Complex normal = complex_mul(slide->velocity_normal, slide->start.phasors.normal);
    double curvature = 2.0 * slide->k2 - w * w * drive.re - q * q * normal.re - plant->mass_fraction * third;
    double bound = w * w * w * complex_abs(slide->velocity_drive) +
                   q * q * fabs(q) * complex_abs(slide->velocity_normal) +
                   plant->mass_fraction * hypot(fourth, plant->slip.frequency * third);
    return 3.0 * fmax(0.0, slide->direction * curvature) / fmax(bound, SMALLEST);
}

/* The turns at `t`. Those of the latest time for which sines are computed become the anchor. */
static inline const Turns *watched_turns(SplitSlide *slide, double t, Turns *place) {
    bool is_latest = !is_near(slide, t) && (!slide->anchored || t > slide->anchor.t);
    if (!is_latest) {
        return turns_at(slide, t, place);
    }
    compute_turns(slide, t, &slide->anchor);
    slide->anchored = true;
    return &slide->anchor;
}

static Signal velocity_ahead(void *motion, double t) {
    SplitSlide *slide = motion;
    const Oscillator *slip = &slide->plant->slip;
    Turns place;
    const Turns *turns = watched_turns(slide, t, &place);
    Response free = free_motion_at(slide, turns);
    double second = -2.0 * slip->decay * free.rate - slip->stiffness * free.displacement;
    return (Signal){slide->direction * velocity_by(slide, turns, free.rate),
                    slide->direction * acceleration_by(slide, turns, second), bound_by(slide, free.rate, second)};
}

Watch split_slide_watch(SplitSlide *slide) {
    return (Watch){velocity_ahead, slide, slide->noise, slide->split->fastest};
}

/* The margin in a direction. The energy of the free motion never grows: it bounds the force by that later. */
static Signal margin_ahead(SplitSlide *slide, double direction, double t) {
    const Plant *plant = slide->plant;
    const Oscillator *held = &plant->slip;
    double w = plant->drive_frequency, q = plant->normal_frequency, spring = plant->spring, damper = plant->damper;
    Turns place;
    const Turns *turns = watched_turns(slide, t, &place);
    Response free = free_motion_at(slide, turns);
    Complex forced = complex_mul(slide->resonator_drive, turns->phasors.drive);
    Complex direct = complex_mul(plant->holding_drive, turns->phasors.drive);
    Complex limit = complex_scale(plant->friction_amplitude, normal_phasor(plant, &turns->phasors));
    double rate = free.rate - w * forced.im, swing = w * w * complex_abs(slide->resonator_drive);
    double second = -2.0 * held->decay * free.rate - held->stiffness * free.displacement;
    double energy = hypot(2.0 * held->decay * second + held->stiffness * free.rate, held->frequency * second);
    double force = spring * (free.displacement + forced.re) + damper * rate + direct.im - plant->load;
    double change = spring * rate + damper * (second - w * w * forced.re) + w * direct.re - plant->load_rate;
    double bound = spring * (energy / held->frequency + swing) + damper * (energy + w * swing) +
                   w * w * complex_abs(plant->holding_drive) + q * q * plant->friction_amplitude;
    return (Signal){plant->friction_preload + limit.im - direction * (force - plant->load_rate * t),
                    q * limit.re - direction * change, bound};
}

static Signal forward_margin(void *motion, double t) {
    return margin_ahead(motion, 1.0, t);
}

static Signal backward_margin(void *motion, double t) {
    return margin_ahead(motion, -1.0, t);
}

int split_slide_margins(SplitSlide *slide, double longest, Watch watches[2]) {
    const Plant *plant = slide->plant;
    double w = plant->drive_frequency, frequency = plant->slip.frequency, swing = complex_abs(slide->resonator_drive);
    double rate = hypot(slide->free_start.rate, frequency * slide->free_start.displacement);
    double force = fabs(plant->load) + fabs(plant->load_rate) * longest + complex_abs(plant->holding_drive) +
                   plant->spring * (rate / frequency + swing) + plant->damper * (rate + w * swing);
    double limit = plant->friction_preload + plant->friction_amplitude;
    double least = plant->friction_preload - plant->friction_amplitude;
    double noise = 4.0 * EPSILON * (limit + fmin(force, 1e3 * limit)), fastest = slide->split->fastest;
    watches[0] = (Watch){forward_margin, slide, noise, fastest};
    watches[1] = (Watch){backward_margin, slide, noise, fastest};
    return force == 0.0 || force < 0.999999 * least ? 0 : 2;
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

/* The integral K up to turns [m], but for an addend that does not change, and what stands still in n v. */
static Complex swung_until(const SplitSlide *slide, const Turns *turns, Response free) {
    const Split *split = slide->split;
    double q = slide->plant->normal_frequency, t = turns->t, per = 1.0 / q;
    double steady = slide->k0 + (slide->k1 + slide->k2 * t) * t, slope = slide->k1 + 2.0 * slide->k2 * t;
    double first = split->integral[0], second = split->integral[1];
    Complex drive = complex_mul(slide->velocity_drive, turns->phasors.drive);
    Complex swing = complex_of(slide->plant->slip.stiffness * free.displacement, q * free.rate);
    Complex sum = complex_of(slope * per * per, (2.0 * slide->k2 * per * per - steady) * per);
    sum = complex_sub(sum, complex_mul(split->recoil, swing));
    sum.re += (second - first) * drive.im;
    sum.im += (first + second) * drive.re;
    if (!split->merges) {
        Complex normal = complex_mul(slide->velocity_normal, turns->phasors.normal);
        sum.re += 0.25 * per * normal.im;
        sum.im -= 0.25 * per * normal.re;
    }
    return complex_mul(normal_phasor(slide->plant, &turns->phasors), sum);
}

/* Im K [m] up to turns. */
static double swung_by(const SplitSlide *slide, const Turns *turns, Response free) {
    const Split *split = slide->split;
    Complex first = swung_until(slide, &slide->start, slide->free_start);
    double t = turns->t, total = swung_until(slide, turns, free).im - first.im;
    for (int i = 0; i < 2; i++) {
        if (split->integral[i] == 0.0) {
            Complex drive = complex_mul(slide->velocity_drive, slide->start.phasors.drive);
            Complex phasor = normal_phasor(slide->plant, &slide->start.phasors);
            phasor = complex_mul(phasor, i == 0 ? drive : complex_conj(drive));
            if (split->frequency[i] != 0.0) {
                phasor = complex_mul(phasor, growth_of(complex_of(0.0, split->frequency[i] * t)).once);
            }
            total += 0.5 * t * phasor.im;
        }
    }
    return split->merges ? total : total - 0.5 * t * slide->velocity_normal.im;
}

/* Work of friction [J] up to turns, where the displacement [m] and the free motion are known. */
static double work_by(const SplitSlide *slide, const Turns *turns, Response free, double travelled) {
    const Plant *plant = slide->plant;
    if (!slide->works) {
        return 0.0;
    }
    bool stands = plant->normal_frequency == 0.0;
    double swung = stands ? slide->start.phasors.normal.im * travelled : swung_by(slide, turns, free);
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
    Passage passed = {travel, work_by(slide, turns, free, travel)};
    return (Place){state, passed, {!is_soon(slide, t), turns->phasors}};
}
