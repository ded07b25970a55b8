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
