#include "oscillator.h"

#include "../base/elementary.h"

/* Damping ratio below which the complex eigenvalue is used; hyperbolic forms are used above. */
#define OSCILLATORY 0.9

/* Relative distance of forcing frequency and eigenvalue below which the particular solution, which
 * grows with the inverse of that distance, is replaced by the response from rest. */
#define RESONANT 0.02

Oscillator oscillator_of(double decay, double stiffness) {
    Oscillator oscillator = {decay, stiffness, sqrt(stiffness), false, {0.0, 0.0}};
    if (decay < OSCILLATORY * oscillator.frequency) {
        oscillator.oscillatory = true;
        oscillator.eigenvalue = complex_of(-decay, sqrt(stiffness - decay * decay));
    }
    return oscillator;
}

double slower_decay(const Oscillator *oscillator) {
    double decay = oscillator->decay, stiffness = oscillator->stiffness;
    double excess = decay * decay - stiffness;
    return excess > 0.0 ? stiffness / (decay + sqrt(excess)) : decay;
}

Complex transfer(const Oscillator *oscillator, double frequency) {
    Complex impedance = complex_of(oscillator->stiffness - frequency * frequency,
                                   2.0 * oscillator->decay * frequency);
    return complex_div(complex_of(1.0, 0.0), impedance);
}

bool resonates(const Oscillator *oscillator, double frequency) {
    if (!oscillator->oscillatory) {
        return false;
    }
    Complex distance = complex_sub(oscillator->eigenvalue, complex_of(0.0, fabs(frequency)));
    return complex_abs(distance) < RESONANT * complex_abs(oscillator->eigenvalue);
}

Response free_response(const Oscillator *oscillator, double t) {
    double decay = oscillator->decay, stiffness = oscillator->stiffness;
    double difference = stiffness - decay * decay;
    if (difference > 0.0) {
        double damped = sqrt(difference), envelope = exp(-decay * t);
        SineCosine turn = elementary_sine_cosine(damped * t);
        return (Response){envelope * turn.cosine, envelope * turn.sine / damped};
    }
    double spread = sqrt(-difference);
    double slow = decay > 0.0 ? exp(-stiffness / (decay + spread) * t) : 1.0;
    if (spread * t < 1e-150) {
        return (Response){slow, slow * t};
    }
    double gap = -expm1(-2.0 * spread * t);
    return (Response){slow * (1.0 - 0.5 * gap), slow * gap / (2.0 * spread)};
}

/* exp(z) - 1 without cancellation for small z */
static Complex complex_expm1(Complex z) {
    double half = sin(0.5 * z.im), growth = expm1(z.re);
    return complex_of(growth * cos(z.im) - 2.0 * half * half, (growth + 1.0) * sin(z.im));
}

/* (exp(a t) - exp(b t)) / (a - b) from these exponentials; regular at a = b [s] */
static Complex divided_difference(Complex a, Complex grown_a, Complex b, Complex grown_b,
                                  double t) {
    Complex difference = complex_sub(a, b);
    double apart = fmax(fabs(difference.re), fabs(difference.im)) * t;
    if (apart > 1.0) {
        return complex_div(complex_sub(grown_a, grown_b), difference);
    }
    if (apart == 0.0) {
        return complex_scale(t, grown_b);
    }
    Complex gained = complex_mul(grown_b, complex_expm1(complex_scale(t, difference)));
    return complex_div(gained, difference);
}

ComplexResponse response_from_rest(const Oscillator *oscillator, double frequency, double t,
                                   Response free, Complex turn) {
    Complex eigenvalue = oscillator->eigenvalue, conjugate = complex_conj(eigenvalue);
    Complex forcing = complex_of(0.0, frequency);
    Complex grown = complex_of(free.displacement, eigenvalue.im * free.rate);
    Complex near = divided_difference(eigenvalue, grown, forcing, turn, t);
    Complex far = divided_difference(conjugate, complex_conj(grown), forcing, turn, t);
    Complex width = complex_of(0.0, 2.0 * eigenvalue.im);
    Complex moved = complex_sub(complex_mul(eigenvalue, near), complex_mul(conjugate, far));
    return (ComplexResponse){complex_div(complex_sub(near, far), width),
                             complex_div(moved, width)};
}

Complex exponential_integral(double frequency, double t) {
    double half = 0.5 * frequency * t;
    return complex_rect(half != 0.0 ? t * sin(half) / half : t, half);
}

Complex exponential_double_integral(double frequency, double t) {
    double angle = frequency * t;
    if (fabs(angle) > 0.5) {
        Complex grown = complex_expm1(complex_of(0.0, angle));
        Complex bent = complex_sub(grown, complex_of(0.0, angle));
        return complex_scale(-1.0 / (frequency * frequency), bent);
    }
    Complex term = complex_of(0.5, 0.0), total = term;
    for (int n = 3; n < 16; n++) {
        term = complex_mul(term, complex_of(0.0, angle / n));
        total = complex_add(total, term);
    }
    return complex_scale(t * t, total);
}
