#include "averaged.h"

#include <stdbool.h>

#include "complex_number.h"
#include "elementary.h"
#include "fast_vibration.h"
#include "friction_law.h"
#include "plant.h"
#include "refusal.h"
#include "state.h"

/* Halvings of [0, pi] in which bisection finds the angle of balance; the first of these, which select
 * one of several balances; evaluations of Chandrupatla's method; halvings that locate the edge of a
 * flat balance. */
enum { BISECTIONS = 52, SORTING = 4, MAX_EVALUATIONS = 100, EDGE_HALVINGS = 40 };

/* Width [rad] of the bracket at which Chandrupatla's method ends. */
#define CLOSE 2e-15

/* Width [rad] of a bracket below which any angle in it serves as the balance. */
#define STEEP 1e-12

/* Width [rad] of a balance from which on it is flat, not just uncertain by rounding. */
#define FLAT 3e-3

/* Rounding error of a mean friction, in units of the last place of the largest friction. */
#define ROUNDING 8.0

/* Friction and load as functions of the angle Theta at which sliding turns forward; `noise` is the
 * rounding error of their sum [N]. Where friction has a `closed` form it is the sum of `preload`,
 * `sine` and `cosine` [N] times its means. Where it `rises` with the angle there may be several
 * balances. */
typedef struct {
    const Law *law;
    double opposing, noise;
    bool closed, rises;
    double preload, sine, cosine;
    FastMotion fast;
    VibratingLoad load;
} Balance;

/* The sum of friction and load (`excess`) [N] at an angle Theta (`turning`) [rad]. */
typedef struct {
    double turning, excess;
} Point;

/* Angles [rad]: up to `positive` the excess is above 0 beyond rounding, from `negative` on it is below
 * 0. In between it is 0 within rounding; `root` is the best estimate. */
typedef struct {
    double positive, negative, root;
} Bracket;

static Balance balance_of(const Law *law, Complex force, double normal_lead) {
    const Device *device = &law->device;
    const AveragedFriction *friction = law->friction->averaged;
    Balance balance = {.law = law, .opposing = law->inputs.load};
    double ratio = law->inputs.frequency_ratio, faces = device->friction_faces;
    double delta = law->inputs.phase + normal_lead + ratio * force_lag(force);
    balance.fast = (FastMotion){fast_velocity(device, force), device->drive_frequency};
    balance.load = vibrating_load_of(device, ratio, delta);
    balance.closed = !friction->is_expensive && !balance.load.is_constant &&
                     device->normal_amplitude <= device->normal_preload;
    double mu = law->bristle.coefficient;
    double drag = friction->drag(&law->bristle, balance.fast.velocity);
    balance.rises = drag > mu;
    balance.noise = ROUNDING * EPSILON * faces * (mu + drag) *
                    (device->normal_preload + device->normal_amplitude);
    balance.preload = faces * device->normal_preload;
    balance.sine = faces * device->normal_amplitude * cos(delta);
    balance.cosine = faces * device->normal_amplitude * sin(delta);
    return balance;
}

/* Mean friction [N] when sliding turns forward at tau = `turning` [rad]. */
static double friction_at(const Balance *balance, double turning) {
    const Law *law = balance->law;
    return law->device.friction_faces * law->friction->averaged->mean(&law->bristle, &balance->fast,
                                                                      &balance->load, turning);
}

static Point point_at(const Balance *balance, double turning) {
    return (Point){turning, friction_at(balance, turning) + balance->opposing};
}

/* The same, by the closed form where there is one: it takes less time. */
static Point point_near(const Balance *balance, double turning) {
    if (!balance->closed) {
        return point_at(balance, turning);
    }
    const Law *law = balance->law;
    FrictionMeans means = law->friction->averaged->means(&law->bristle, &balance->fast,
                                                         balance->load.ratio, turning);
    return (Point){turning, balance->preload * means.plain + balance->sine * means.sine +
                                balance->cosine * means.cosine + balance->opposing};
}

/* Narrows the bracket by a point; returns whether the sign of its excess is certain. */
static bool bracket_narrows(Bracket *bracket, const Balance *balance, Point point) {
    if (!(fabs(point.excess) > balance->noise)) {
        return false;
    }
    if (point.excess > 0.0) {
        bracket->positive = fmax(bracket->positive, point.turning);
    } else {
        bracket->negative = fmin(bracket->negative, point.turning);
    }
    return true;
}

/* Inverse quadratic interpolation through the newest point `a`, the opposite one `b` and the one before,
 * `c`: gives the `share` of the way from a to b, and returns whether Chandrupatla's criterion accepts it. */
static bool interpolates(Point a, Point b, Point c, double *share) {
    double xi = (a.turning - b.turning) / (c.turning - b.turning);
    double phi = (a.excess - b.excess) / (c.excess - b.excess);
    *share = a.excess / (b.excess - a.excess) * c.excess / (b.excess - c.excess) +
             (c.turning - a.turning) / (b.turning - a.turning) * a.excess / (c.excess - a.excess) *
                 b.excess / (c.excess - b.excess);
    return phi * phi < xi && (1.0 - phi) * (1.0 - phi) < 1.0 - xi;
}

/* Chandrupatla's method: inverse quadratic interpolation where its criterion accepts it, bisection
 * otherwise. The excess is above 0 at `low` and not at `high`; `next` is between. */
static Bracket close_in(const Balance *balance, Point low, Point next, Point high) {
    Point newest = high, other = low;
    Bracket bracket = {low.turning, high.turning, 0.0};
    for (int i = 0; i < MAX_EVALUATIONS; i++) {
        Point before = newest;
        if ((next.excess > 0.0) != (newest.excess > 0.0)) {
            before = other;
            other = newest;
        }
        newest = next;
        double width = other.turning - newest.turning, min_share = CLOSE / fabs(width), share;
        if (!bracket_narrows(&bracket, balance, newest) || !(min_share < 0.5)) {
            break;
        }
        share = interpolates(newest, other, before, &share) ? share : 0.5;
        share = fmin(fmax(share, min_share), 1.0 - min_share);
        next = point_near(balance, newest.turning + share * width);
    }
    bracket.root = fabs(newest.excess) < fabs(other.excess) ? newest.turning : other.turning;
    double flatness = fabs((other.turning - newest.turning) / (other.excess - newest.excess));
    double aside = CLOSE + 1.5 * balance->noise * flatness;
    if (bracket.positive < bracket.root - aside) {
        bracket_narrows(&bracket, balance, point_near(balance, bracket.root - aside));
    }
    if (bracket.negative > bracket.root + aside) {
        bracket_narrows(&bracket, balance, point_near(balance, bracket.root + aside));
    }
    return bracket;
}

/* The edge of a flat balance, between an angle `outside` and one `inside` [rad]. */
static double flat_edge(const Balance *balance, double outside, double inside, double sign) {
    for (int i = 0; i < EDGE_HALVINGS; i++) {
        double middle = 0.5 * (outside + inside);
        *(sign * point_at(balance, middle).excess > balance->noise ? &outside : &inside) = middle;
    }
    return inside;
}

/* The lower end [rad] of the range in which friction and load balance; NAN where it is narrower than
 * FLAT. */
static double flat_from(const Balance *balance, const Bracket *bracket) {
    if (fabs(point_at(balance, bracket->root).excess) > balance->noise) {
        return NAN;
    }
    double begin = flat_edge(balance, bracket->positive, bracket->root, 1.0);
    double end = flat_edge(balance, bracket->negative, bracket->root, -1.0);
    return end - begin > FLAT ? begin : NAN;
}

/* Angle at which friction and load balance [rad]: the result of plain bisection, but signs that the
 * bracket already implies are not evaluated. On a flat balance (even ratios, with flight while sliding
 * turns) it is the end of the highest velocity. On a weak one it is uncertain by rounding. */
static double balanced_turning(const Balance *balance, Point low, Point halfway, Point high) {
    int done = 0;
    for (; done < (balance->rises ? SORTING : 0); done++) {
        *(halfway.excess > 0.0 ? &low : &high) = halfway;
        halfway = point_at(balance, 0.5 * (low.turning + high.turning));
    }
    Bracket bracket = {low.turning, high.turning, 0.0};
    if (low.excess > 0.0 && high.excess <= 0.0) {
        bracket = close_in(balance, low, halfway, high);
    } else if (!balance->rises) {
        return low.excess > 0.0 ? high.turning : low.turning;
    }
    if (bracket.positive > bracket.negative) {
        bracket.positive = low.turning;
        bracket.negative = high.turning;
    }
    if (bracket.negative - bracket.positive < STEEP) {
        return bracket.root;
    }
    double flat = flat_from(balance, &bracket);
    if (!isnan(flat)) {
        return flat;
    }
    for (; done < BISECTIONS; done++) {
        double turning = 0.5 * (low.turning + high.turning);
        bool above = turning <= bracket.positive;
        if (!above && turning < bracket.negative) {
            above = point_at(balance, turning).excess > 0.0;
        }
        *(above ? &low.turning : &high.turning) = turning;
    }
    return 0.5 * (low.turning + high.turning);
}

TheoryRange theory_range(const Law *law) {
    const Device *device = &law->device;
    TheoryRange range = {0.0, 0.0, 0.0};
    Complex force;
    Refusal refusal;
    if (equivalent_force(device, &force, &refusal)) {
        range.velocity = fast_velocity(device, force);
    }
    double mu = law->bristle.coefficient;
    double fastest = fmax(range.velocity, fabs(device->initial_velocity));
    double drag = law->friction->averaged->drag(&law->bristle, fastest);
    double normal = device->normal_preload + device->normal_amplitude;
    range.drag = drag / (mu > 0.0 ? mu : 1.0); /* Without friction there is no drag. */
    double bent = fabs(law->friction->first_bristle(law)) * (1.0 + range.drag);
    range.strongest = TAU * normal * (1.0 + device->friction_faces * (mu + drag + bent));
    return range;
}

/* Whether the vibration alone overcomes the mean `friction` [N] of sliding: the amplitude `force` [N] of
 * its force on the pair must, and so must that of its force on a held slider. */
static bool breaks_loose(const Balance *balance, double force, double friction) {
    const Bristle *bristle = &balance->law->bristle;
    double w = balance->fast.frequency, amplitude = balance->fast.velocity / w;
    double grip = balance->law->friction->averaged->grip(bristle, amplitude, w);
    return fmin(force, held_amplitude(&balance->law->device))
           > friction * (grip / bristle->coefficient);
}

Averaged averaged(const Law *law, double normal_lead) {
    Complex force;
    Refusal refusal;
    if (!equivalent_force(&law->device, &force, &refusal) || (force.re == 0.0 && force.im == 0.0)) {
        return (Averaged){0.0, 0.0, false};
    }
    Balance balance = balance_of(law, force, normal_lead);
    double first = friction_at(&balance, 0.0), last = friction_at(&balance, PI);
    double load = law->inputs.load;
    if (first == last) {
        /* No friction: every velocity is steady without a load, and none with one. */
        double fastest = load != 0.0 ? -copysign(balance.fast.velocity, load) : 0.0;
        return (Averaged){fastest, 0.0, false};
    }
    double middle = friction_at(&balance, 0.5 * PI);
    Point low = {0.0, first + load}, halfway = {0.5 * PI, middle + load}, high = {PI, last + load};
    double turning = balanced_turning(&balance, low, halfway, high);
    bool valid = fabs(load) < first && breaks_loose(&balance, complex_abs(force), first);
    return (Averaged){balance.fast.velocity * cos(turning), -middle, valid};
}
