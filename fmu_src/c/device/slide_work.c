#include "slide_work.h"

/* Share of the drive frequency below which the ends of a phasor differ too little to integrate it by them. */
#define STANDING 1e-3

SlideWork slide_work_of(const Plant *plant) {
    double w = plant->drive_frequency, q = plant->normal_frequency;
    Complex response = complex_of(0.0, 0.0);
    if (plant->resolves_resonator) {
        response = complex_scale(plant->mass_fraction, complex_conj(transfer(&plant->slip, q)));
    }
    Complex reaction = complex_scale(q * q, response);
    Complex shaken = complex_scale(plant->relative_drive, reaction);
    SlideWork work = {.frequency = {q + w, q - w}};
    work.rate = complex_mul(response, complex_of(plant->slip.stiffness, -2.0 * plant->slip.decay * q));
    work.displacement = complex_mul(response, complex_of(0.0, -q * plant->slip.stiffness));
    work.steady = complex_scale(1.0 / plant->slider_mass, reaction);
    work.steady.re -= 1.0 / plant->total_mass;
    Complex by_drive[2] = {complex_add(plant->drive, shaken), complex_add(complex_conj(plant->drive), shaken)};
    for (int i = 0; i < 2; i++) {
        Complex amplitude = complex_mul(complex_of(0.0, i - 0.5), by_drive[i]), zero = complex_of(0.0, 0.0);
        bool swings = fabs(work.frequency[i]) > STANDING * w;
        work.forced[i] = swings ? zero : amplitude;
        work.swung[i] = swings ? complex_div(amplitude, complex_of(0.0, work.frequency[i])) : zero;
    }
    return work;
}

/* The boundary term at an end: without the resisting force that is constant, `constant`, and with the swinging part of
 * friction, `own`. */
static Complex boundary(const SlideWork *work, const SlideEnd *end, Complex constant, Complex own) {
    Complex sum = complex_scale(end->state.rate, work->rate);
    sum = complex_add(sum, complex_scale(end->state.displacement, work->displacement));
    sum.re += end->state.velocity;
    sum = complex_sub(sum, complex_add(constant, complex_mul(own, end->normal)));
    sum = complex_sub(sum, complex_mul(work->swung[0], end->drive));
    sum = complex_sub(sum, complex_mul(work->swung[1], complex_conj(end->drive)));
    return complex_mul(end->normal, sum);
}

double slide_work_swung(const SlideWork *work, const Plant *plant, int sign, double t, const SlideEnd *first,
                        const SlideEnd *last) {
    double q = plant->normal_frequency;
    Complex per_rate = complex_of(0.0, -1.0 / q);
    double held = plant->load + sign * plant->friction_preload;
    Complex swinging = complex_scale(sign * plant->friction_amplitude, work->steady);
    Complex own = complex_scale(-0.25 / q, swinging);
    Complex gained = complex_mul(per_rate, complex_scale(plant->load_rate, work->steady));
    Complex constant = complex_mul(per_rate, complex_scale(held, work->steady));
    constant = complex_sub(constant, complex_mul(per_rate, gained));
    Complex constant_last = complex_add(constant, complex_scale(t, gained));
    Complex total = complex_sub(boundary(work, last, constant_last, own), boundary(work, first, constant, own));
    total = complex_sub(total, complex_mul(complex_of(0.0, 0.5 * t), swinging));
    for (int i = 0; i < 2; i++) {
        if (work->forced[i].re != 0.0 || work->forced[i].im != 0.0) {
            Complex turn = i == 0 ? first->drive : complex_conj(first->drive);
            Complex phasor = complex_scale(t, complex_mul(first->normal, turn));
            if (work->frequency[i] != 0.0) {
                phasor = complex_mul(phasor, growth_of(complex_of(0.0, work->frequency[i] * t)).once);
            }
            total = complex_sub(total, complex_mul(work->forced[i], phasor));
        }
    }
    return -total.re / q;
}
