#include "forced_oscillator.h"

#include <math.h>

/* Horizon of the bounds of responses from rest, as an angle [rad] of the highest frequency: longer than
 * most slides. */
#define AHEAD 5.0

static Following how_to_follow(const Oscillator *oscillator, double frequency, bool slow,
                               double fastest) {
    if (frequency == 0.0) {
        return AS_CONSTANT;
    }
    if (slow && fabs(frequency) < SLOW * fastest) {
        return SLOW_FROM_REST;
    }
    return resonates(oscillator, frequency) ? RESONANT_FROM_REST : STEADY;
}

void forced_oscillator_begin(ForcedOscillator *motion, const Oscillator *oscillator,
                             double constant, double slope, const Forcing *forcing, int forcings,
                             double y0, double u0, double fastest) {
    bool slow = fmax(oscillator->frequency, oscillator->decay) < SLOW * fastest;
    double highest = oscillator->frequency;
    motion->oscillator = oscillator;
    motion->forcings = forcings;
    motion->from_rest = false;
    for (int i = 0; i < forcings; i++) {
        double frequency = forcing[i].frequency;
        Complex amplitude = forcing[i].amplitude;
        Following following = how_to_follow(oscillator, frequency, slow, fastest);
        if (following == AS_CONSTANT) {
            constant += amplitude.re;
        } else if (following == STEADY) {
            motion->steady[i] = complex_mul(amplitude, transfer(oscillator, frequency));
            motion->size[i] = complex_abs(motion->steady[i]);
            y0 -= motion->steady[i].re;
            u0 += frequency * motion->steady[i].im;
        } else {
            motion->size[i] = complex_abs(amplitude);
            motion->from_rest = true;
            highest = fmax(highest, fabs(frequency));
        }
        motion->forcing[i] = forcing[i];
        motion->following[i] = following;
    }
    motion->constant = constant;
    motion->slope = slope;
    motion->longest = LONGEST_ARC / fastest;
    motion->free_displacement = y0;
    motion->free_rate = u0;
    motion->horizon = motion->from_rest ? AHEAD / highest : INFINITY;
}

/* Motion under the linear forcing alone; `free` is the free response of the oscillator. */
static Response free_motion(const ForcedOscillator *motion, double t, Response free) {
    const Oscillator *oscillator = motion->oscillator;
    double y0 = motion->free_displacement, u0 = motion->free_rate;
    double sway = oscillator->decay * free.rate;
    Response response;
    response.displacement = y0 * (free.displacement + sway) + u0 * free.rate;
    response.rate = u0 * (free.displacement - sway) - oscillator->stiffness * y0 * free.rate;
    if (motion->constant != 0.0) {
        Response step = step_response(oscillator, t, free);
        response.displacement += motion->constant * step.displacement;
        response.rate += motion->constant * step.rate;
    }
    if (motion->slope != 0.0) {
        Response ramp = ramp_response(oscillator, t, free);
        response.displacement += motion->slope * ramp.displacement;
        response.rate += motion->slope * ramp.rate;
    }
    return response;
}

/* Response to forcing `i` from rest; of a negative frequency by its mirror image. */
static Response forced_from_rest(const ForcedOscillator *motion, int i, double t, Response free,
                                 Complex turn) {
    double frequency = motion->forcing[i].frequency;
    Complex amplitude = motion->forcing[i].amplitude;
    ComplexResponse unit;
    if (motion->following[i] == SLOW_FROM_REST) {
        unit = slow_response_from_rest(motion->oscillator, frequency, t);
    } else {
        amplitude.im = frequency > 0.0 ? amplitude.im : -amplitude.im;
        turn.im = frequency > 0.0 ? turn.im : -turn.im;
        unit = response_from_rest(motion->oscillator, fabs(frequency), t, free, turn);
    }
    return (Response){complex_mul(amplitude, unit.displacement).re,
                      complex_mul(amplitude, unit.rate).re};
}

Response forced_oscillator_response(const ForcedOscillator *motion, double t, const Complex *turn) {
    Response free = free_response(motion->oscillator, t);
    Response response = free_motion(motion, t, free);
    for (int i = 0; i < motion->forcings; i++) {
        double frequency = motion->forcing[i].frequency;
        if (motion->following[i] == STEADY) {
            Complex turned = complex_mul(motion->steady[i], turn[i]);
            response.displacement += turned.re;
            response.rate -= frequency * turned.im;
        } else if (motion->following[i] != AS_CONSTANT) {
            Response forced = forced_from_rest(motion, i, t, free, turn[i]);
            response.displacement += forced.displacement;
            response.rate += forced.rate;
        }
    }
    return response;
}

Sample forced_oscillator_sample(const ForcedOscillator *motion, double t) {
    const Oscillator *oscillator = motion->oscillator;
    double decay = oscillator->decay, stiffness = oscillator->stiffness;
    double frequency = oscillator->frequency;
    Response free = free_response(oscillator, t), moved = free_motion(motion, t, free);
    double applied = motion->constant + motion->slope * t, even_rate = motion->slope / stiffness;
    double free_acceleration = applied - 2.0 * decay * moved.rate - stiffness * moved.displacement;
    Sample sample;
    turns_of(motion->forcing, motion->forcings, t, sample.turn);
    sample.jerk_bound =
        hypot(2.0 * decay * free_acceleration + stiffness * moved.rate - motion->slope,
              frequency * free_acceleration);
    sample.acceleration_bound = sample.jerk_bound / frequency;
    sample.rate_bound =
        hypot(moved.rate - even_rate, free_acceleration / frequency) + fabs(even_rate);
    for (int i = 0; i < motion->forcings; i++) {
        if (motion->following[i] == AS_CONSTANT) {
            continue;
        }
        double f = motion->forcing[i].frequency;
        Complex turn = sample.turn[i];
        applied += complex_mul(motion->forcing[i].amplitude, turn).re;
        if (motion->following[i] == STEADY) {
            Complex turned = complex_mul(motion->steady[i], turn);
            double size = motion->size[i] * f * f;
            moved.displacement += turned.re;
            moved.rate -= f * turned.im;
            sample.rate_bound += motion->size[i] * fabs(f);
            sample.acceleration_bound += size;
            sample.jerk_bound += size * fabs(f);
        } else {
            Response forced = forced_from_rest(motion, i, t, free, turn);
            double ahead = t + motion->horizon;
            double size =
                motion->size[i] * (fabs(f) + 2.0 * decay + frequency + ahead * f * f);
            moved.displacement += forced.displacement;
            moved.rate += forced.rate;
            sample.rate_bound += motion->size[i] * ahead;
            sample.acceleration_bound += size / frequency;
            sample.jerk_bound += size;
        }
    }
    sample.displacement = moved.displacement;
    sample.rate = moved.rate;
    sample.acceleration = applied - 2.0 * decay * moved.rate - stiffness * moved.displacement;
    return sample;
}

Response forced_oscillator_reach(const ForcedOscillator *motion) {
    Response reach = {INFINITY, INFINITY};
    if (motion->from_rest) {
        return reach;
    }
    double frequency = motion->oscillator->frequency;
    double offset = motion->constant / motion->oscillator->stiffness;
    reach.rate = hypot(motion->free_rate, frequency * (motion->free_displacement - offset));
    reach.displacement = reach.rate / frequency + fabs(offset);
    if (motion->slope != 0.0) {
        /* The rate under a ramp is the displacement after a step: at most twice the steady one. */
        double stiffness = motion->oscillator->stiffness, longest = motion->longest;
        double ramped = fabs(motion->slope) * fmin(2.0 / stiffness, 0.5 * longest * longest);
        reach.rate += ramped;
        reach.displacement += ramped * longest;
    }
    for (int i = 0; i < motion->forcings; i++) {
        if (motion->following[i] == STEADY) {
            reach.displacement += motion->size[i];
            reach.rate += fabs(motion->forcing[i].frequency) * motion->size[i];
        }
    }
    return reach;
}
