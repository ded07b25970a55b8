#include "oscillator.h"

#include <float.h>
#include <math.h>

/* Damping ratio below which the complex eigenvalue is used; hyperbolic forms are used above. */
#define OSCILLATORY 0.9

/* Angle [rad] up to which power series in time are used. */
#define SOON 0.3

/* Largest number of terms of a series, and relative size of terms at which it ends. */
enum { TERMS = 40 };
#define NEGLIGIBLE 1e-19

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
        return (Response){envelope * cos(damped * t), envelope * sin(damped * t) / damped};
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

Response step_response(const Oscillator *oscillator, double t, Response free) {
    double decay = oscillator->decay, stiffness = oscillator->stiffness;
    double frequency = oscillator->frequency;
    Response response = {0.0, free.rate};
    if (fmax(decay, frequency) * t < SOON) {
        response.displacement = slow_response_from_rest(oscillator, 0.0, t).displacement.re;
        return response;
    }
    if (decay > frequency) {
        double spread = sqrt(decay * decay - stiffness);
        double slow = stiffness / (decay + spread), fast = decay + spread;
        if (spread > 0.1 * decay) {
            response.displacement =
                (expm1(-fast * t) / fast - expm1(-slow * t) / slow) / (fast - slow);
            return response;
        }
    }
    response.displacement = (1.0 - free.displacement - decay * free.rate) / stiffness;
    return response;
}

/* (exp(-x) - 1 + x) / x^2 for x >= 0, regular at 0. */
static double second_exponential(double x) {
    if (x > SOON) {
        return (expm1(-x) + x) / (x * x);
    }
    double term = 0.5, total = term;
    for (int n = 3; n < 16; n++) {
        term *= -x / n;
        total += term;
    }
    return total;
}

/* Displacement in response to t from rest, by its power series. */
static double early_ramp(const Oscillator *oscillator, double t) {
    double damping = 2.0 * oscillator->decay * t, stiffness = oscillator->stiffness * t * t;
    double before = 0.0, term = t * t * t / 6.0, total = term;
    for (int n = 4; n < TERMS; n++) {
        double next = -(damping * (n - 1) * term + stiffness * before) / (n * (n - 1));
        before = term;
        term = next;
        total += term;
        if (fabs(before) + fabs(term) <= NEGLIGIBLE * fabs(total)) {
            break;
        }
    }
    return total;
}

Response ramp_response(const Oscillator *oscillator, double t, Response free) {
    double decay = oscillator->decay, stiffness = oscillator->stiffness;
    double frequency = oscillator->frequency;
    Response step = step_response(oscillator, t, free);
    Response response = {0.0, step.displacement};
    if (fmax(decay, frequency) * t < SOON) {
        response.displacement = early_ramp(oscillator, t);
        return response;
    }
    if (decay > frequency) {
        double spread = sqrt(decay * decay - stiffness);
        double slow = stiffness / (decay + spread), fast = decay + spread;
        if (spread > 0.1 * decay) {
            double apart = second_exponential(slow * t) - second_exponential(fast * t);
            response.displacement = t * t * apart / (fast - slow);
            return response;
        }
    }
    response.displacement = (t - free.rate - 2.0 * decay * step.displacement) / stiffness;
    return response;
}

static double size_of(Complex a) {
    return fabs(a.re) + fabs(a.im);
}

ComplexResponse slow_response_from_rest(const Oscillator *oscillator, double frequency, double t) {
    double decay = oscillator->decay, stiffness = oscillator->stiffness;
    double per_time = t > DBL_MIN ? 1.0 / t : 0.0;
    Complex before = complex_of(0.0, 0.0), term = complex_of(0.5 * t * t, 0.0);
    Complex forcing = complex_of(t * t, 0.0);
    ComplexResponse response = {term, complex_scale(2.0 * per_time, term)};
    for (int n = 3; n < TERMS; n++) {
        double turned = frequency * t / (n - 2);
        forcing = complex_of(-turned * forcing.im, turned * forcing.re);
        Complex resisting = complex_add(complex_scale(2.0 * decay * t * (n - 1), term),
                                        complex_scale(stiffness * t * t, before));
        before = term;
        term = complex_scale(1.0 / (n * (n - 1)), complex_sub(forcing, resisting));
        response.displacement = complex_add(response.displacement, term);
        response.rate = complex_add(response.rate, complex_scale(n * per_time, term));
        double left = size_of(before) + size_of(term) + size_of(forcing);
        if (left <= NEGLIGIBLE * size_of(response.displacement)) {
            break;
        }
    }
    return response;
}

Complex exponential_integral(double frequency, double t, Complex turn) {
    double angle = frequency * t;
    if (fabs(angle) > 0.5) {
        return complex_of(turn.im / frequency, (1.0 - turn.re) / frequency);
    }
    double half = 0.5 * angle;
    double sinc = half != 0.0 ? sin(half) / half : 1.0;
    return complex_rect(t * sinc, half);
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
