#include "mean_friction.h"

#include <stddef.h>

#include "../base/elementary.h"
#include "../base/gauss_nodes.h"

enum { EDGES = 6, MAX_BISECTIONS = 60 };

/* Edges of the panels of the quadrature over an arc; they crowd where sliding begins. */
static const double EDGE[EDGES] = {0.0, 0.05, 0.15, 0.35, 0.65, 1.0};

/* Widest panel, as an angle [rad] of the normal load: the nodes follow its sine to rounding there. */
#define WIDEST 6.0

/* Path in units of mu / sigma_0 after which a bristle is fully bent to rounding. */
#define BENT 40.0

/* Narrowest part [rad] that is kept apart: what is narrower adds no more than rounding. */
#define NARROW 1e-12

/* MAX_WAVES for the mean power: friction times velocity has no jump, so that what waves add falls with the square of
 * their number, to less than 1e-8 of full power. */
#define MAX_POWER_WAVES 10000.0

/* What the quadrature is over: `waves` of the integrand over a turn, and the load (`load`), with its kinks, or, where
 * that is NULL, unit loads: 1 and sine and cosine of `waves` times the angle. The `sum` of friction beyond Coulomb's
 * under these loads is its result; under a load it has one part, PLAIN. With `powers` it is that of friction times
 * velocity, which is `beyond` [m/s] that by which the slider turns. */
typedef struct {
    const Bristle *bristle;
    const FastMotion *fast;
    bool powers;
    double waves, beyond;
    const VibratingLoad *load;
    double sum[MEANS];
} Quadrature;

/* A part of the turn with one direction of sliding, from the angle `begin` on for `length` [rad], and cosine and sine
 * of where it begins. `unbent` is what the bristle friction there is beyond the limit `direction` mu; for full friction
 * it is 0, and `full` is that limit. */
typedef struct {
    int direction;
    double begin, length, cosine, sine, unbent, full;
} Arc;

/* Terms of the series of x - sin(x), good to rounding up to `SERIES` rad. */
enum { SINE_TERMS = 8 };
#define SERIES 1.0

/* x - sin(x) for x >= 0, without cancellation. */
static double beyond_sine(double x, double sine) {
    if (x > SERIES) {
        return x - sine;
    }
    double square = x * x, sum = 1.0;
    for (int k = SINE_TERMS; k > 1; k--) {
        sum = 1.0 - square / (2 * k * (2 * k + 1)) * sum;
    }
    return x * square / 6.0 * sum;
}

/* Speed over v_q, and path [m] in the direction of the arc, `ahead` [rad] of where it begins. The velocity is v_q
 * (cos(begin) - cos(begin + ahead)); differences of nearly equal numbers are taken in closed form, for hard bristles
 * see short paths. */
typedef struct {
    double speed, path;
} Way;

static Way way(const Quadrature *over, const Arc *arc, double ahead) {
    double half_sine = sin(0.5 * ahead), half_cosine = cos(0.5 * ahead);
    double turned = arc->sine * half_cosine + arc->cosine * half_sine;
    double beyond = beyond_sine(ahead, 2.0 * half_sine * half_cosine);
    double moved = arc->cosine * beyond + 2.0 * arc->sine * half_sine * half_sine;
    double reach = over->fast->velocity / over->fast->frequency;
    return (Way){arc->direction * 2.0 * half_sine * turned, arc->direction * reach * moved};
}

/* How far ahead in the arc [rad] the bristle is fully bent. */
static double bent_at(const Quadrature *over, const Arc *arc) {
    double stiffness = over->bristle->stiffness, full = BENT * over->bristle->coefficient;
    double low = 0.0, high = arc->length;
    if (stiffness * way(over, arc, high).path <= full) {
        return high;
    }
    for (int i = 0; i < MAX_BISECTIONS; i++) {
        double middle = 0.5 * (low + high);
        *(stiffness * way(over, arc, middle).path < full ? &low : &high) = middle;
    }
    return high;
}

/* Adds `friction` per unit load, times a weight of the quadrature, at `angle` [rad]. */
static void gather(Quadrature *over, double angle, double friction) {
    if (over->load != NULL) {
        over->sum[PLAIN] += vibrating_load_at(over->load, angle) * friction;
        return;
    }
    over->sum[PLAIN] += friction;
    over->sum[SINE] += friction * sin(over->waves * angle);
    over->sum[COSINE] += friction * cos(over->waves * angle);
}

static void integrate_panel(Quadrature *over, const Arc *arc, double low, double high) {
    const Bristle *bristle = over->bristle;
    double half = 0.5 * (high - low), mu = bristle->coefficient;
    for (int i = 0; i < GAUSS_NODES; i++) {
        double ahead = low + half * (1.0 + GAUSS_NODE[i]);
        Way gone = way(over, arc, ahead);
        double friction = arc->full;
        if (arc->unbent != 0.0) {
            double fade = exp(-bristle->stiffness * gone.path / mu);
            double drag = bristle->damping * over->fast->velocity * gone.speed;
            friction = arc->unbent * fade * (1.0 - drag / mu);
        }
        if (over->powers) {
            friction *= arc->direction * over->fast->velocity * gone.speed + over->beyond;
        }
        gather(over, arc->begin + ahead, GAUSS_WEIGHT[i] * half * friction);
    }
}

/* Where the smooth part of the load ends that begins `low` ahead of an angle `begin`: at its next kink beyond NARROW,
 * or at `last` [rad]. Always beyond `low`, however the phase is rounded. */
static double smooth_until(const VibratingLoad *load, double begin, double low, double last) {
    double kink = vibrating_load_next_kink(load, begin + low + NARROW) - begin;
    return low < kink && kink < last ? kink : last;
}

/* Panels between edges and kinks, none wider than WIDEST of the normal load. */
static void integrate_arc(Quadrature *over, const Arc *arc) {
    if (!(fabs(arc->unbent + arc->full) > EPSILON * over->bristle->coefficient)) {
        return;
    }
    double length = arc->full != 0.0 ? arc->length : bent_at(over, arc), low = 0.0;
    for (int edge = 1; edge < EDGES; edge++) {
        double last = length * EDGE[edge];
        while (low < last) {
            double high = over->load ? smooth_until(over->load, arc->begin, low, last) : last;
            double pieces = 1.0 + floor(fabs(over->waves) * (high - low) / WIDEST);
            double width = (high - low) / pieces;
            for (double piece = 0.0; piece < pieces; piece += 1.0) {
                integrate_panel(over, arc, low + piece * width, low + (piece + 1.0) * width);
            }
            low = high;
        }
    }
}

/* Quadrature over both arcs of what the bristle still lacks of being fully bent. The response is periodic: sigma_0 z
 * where the forward arc begins follows from the lengths of both. */
static void integrate_turn(Quadrature *over, double turning) {
    double stiffness = over->bristle->stiffness, mu = over->bristle->coefficient;
    double sine = sin(turning), cosine = cos(turning);
    Arc forward = {1, turning, TAU - 2.0 * turning, cosine, sine, 0.0, 0.0};
    Arc backward = {-1, -turning, 2.0 * turning, cosine, -sine, 0.0, 0.0};
    double bent_forward = -expm1(-stiffness * way(over, &forward, forward.length).path / mu);
    double bent_backward = -expm1(-stiffness * way(over, &backward, backward.length).path / mu);
    double bent = bent_forward + bent_backward - bent_forward * bent_backward;
    double at_forward = 0.0, at_backward = 0.0;
    if (bent != 0.0) {
        at_forward = mu * (bent_forward * (1.0 - bent_backward) - bent_backward) / bent;
        at_backward = at_forward + (mu - at_forward) * bent_forward;
    }
    forward.unbent = at_forward - mu;
    backward.unbent = at_backward + mu;
    integrate_arc(over, &forward);
    integrate_arc(over, &backward);
}

/* The load with its mean alone where it has more waves than `most`. */
static VibratingLoad counted_load(const VibratingLoad *load, double most) {
    return fabs(vibrating_load_waves(load)) > most ? vibrating_load_flattened(load) : *load;
}

double mean_power(const Bristle *bristle, const FastMotion *fast, const VibratingLoad *load, double turning,
                  double velocity) {
    VibratingLoad counted = counted_load(load, is_elastic(bristle) ? MAX_WAVES : MAX_POWER_WAVES);
    double mu = bristle->coefficient, sine = sin(turning), cosine = cos(turning);
    Quadrature over = {.bristle = bristle, .fast = fast, .load = &counted, .powers = true};
    over.waves = vibrating_load_waves(&counted);
    over.beyond = velocity - fast->velocity * cosine;
    if (is_elastic(bristle)) {
        integrate_turn(&over, turning);
    }
    Arc forward = {1, turning, TAU - 2.0 * turning, cosine, sine, 0.0, mu};
    Arc backward = {-1, -turning, 2.0 * turning, cosine, -sine, 0.0, -mu};
    integrate_arc(&over, &forward);
    integrate_arc(&over, &backward);
    return over.sum[PLAIN] / TAU;
}

double mean_friction(const Bristle *bristle, const FastMotion *fast, const VibratingLoad *load, double turning) {
    double mu = bristle->coefficient;
    if (!is_elastic(bristle)) {
        return mu * (vibrating_load_difference(load, turning) / TAU);
    }
    VibratingLoad counted = counted_load(load, MAX_WAVES);
    Quadrature over = {.bristle = bristle, .fast = fast, .load = &counted};
    over.waves = vibrating_load_waves(&counted);
    integrate_turn(&over, turning);
    return (mu * vibrating_load_difference(&counted, turning) + over.sum[PLAIN]) / TAU;
}

void friction_means(const Bristle *bristle, const FastMotion *fast, double n, double turning, double means[MEANS]) {
    double mu = bristle->coefficient;
    Quadrature over = {.bristle = bristle, .fast = fast, .waves = n};
    over.sum[PLAIN] = mu * (TAU - 4.0 * turning);
    over.sum[COSINE] = -4.0 * mu * sin(n * turning) / n;
    integrate_turn(&over, turning);
    for (int i = 0; i < MEANS; i++) {
        means[i] = over.sum[i] / TAU;
    }
}
