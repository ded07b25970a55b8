#include "oscillator.h"

#include "../base/elementary.h"

/* Damping ratio below which the complex eigenvalue is used; hyperbolic forms are used above. */
#define OSCILLATORY 0.9

/* Relative distance of forcing frequency and eigenvalue below which the particular solution, which grows with the
 * inverse of that distance, is replaced by the response from rest. */
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
    Complex impedance = complex_of(oscillator->stiffness - frequency * frequency, 2.0 * oscillator->decay * frequency);
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

/* (exp(a t) - exp(b t)) / (a - b) from exp(b t); regular at a = b [s]. */
static Complex divided_difference(Complex a, Complex b, Complex grown_b, double t) {
    Complex angle = complex_scale(t, complex_sub(a, b));
    return complex_scale(t, complex_mul(grown_b, growth_of(angle).once));
}

Response response_from_rest(const Oscillator *oscillator, Complex forcing, double frequency, double t, Complex turn) {
    Complex eigenvalue = oscillator->eigenvalue, conjugate = complex_conj(eigenvalue);
    Complex exponent = complex_of(0.0, frequency);
    Complex near = divided_difference(eigenvalue, exponent, turn, t);
    Complex far = divided_difference(conjugate, exponent, turn, t);
    Complex width = complex_of(0.0, 2.0 * eigenvalue.im);
    Complex moved = complex_sub(complex_mul(eigenvalue, near), complex_mul(conjugate, far));
    return (Response){complex_mul(forcing, complex_div(complex_sub(near, far), width)).re,
                      complex_mul(forcing, complex_div(moved, width)).re};
}
