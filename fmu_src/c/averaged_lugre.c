#include "averaged_lugre.h"

#include <math.h>
#include <stddef.h>

#include "state.h"

enum { NODES = 12, EDGES = 6, MOST_BISECTIONS = 60 };

/* Gauss and Legendre's rule on [-1, 1]. */
static const double NODE[NODES] = {
    0.9815606342467192,  0.9041172563704748,  0.7699026741943047,  0.5873179542866175,
    0.3678314989981802,  0.12523340851146894, -0.1252334085114689, -0.3678314989981802,
    -0.5873179542866175, -0.7699026741943047, -0.9041172563704748, -0.9815606342467192,
};
static const double WEIGHT[NODES] = {
    0.047175336386511835, 0.10693932599531818, 0.16007832854334633, 0.20316742672306584,
    0.23349253653835478,  0.24914704581340288, 0.24914704581340288, 0.23349253653835478,
    0.20316742672306584,  0.16007832854334633, 0.10693932599531818, 0.047175336386511835,
};

/* Edges of the panels of the quadrature over an arc; they crowd where sliding begins. */
static const double EDGE[EDGES] = {0.0, 0.05, 0.15, 0.35, 0.65, 1.0};

/* Widest panel, as an angle [rad] of the normal load: 12 nodes follow its sine to rounding
 * there. */
#define WIDEST 6.0

/* Path in units of mu / sigma_0 after which a bristle is fully bent to rounding. */
#define BENT 40.0

/* Waves of the normal load over a turn of the drive beyond which only its mean counts: what they
 * add to the mean friction falls with their number, to less than 1e-3 of full friction. */
#define MOST_WAVES 1000.0

/* Takes in friction per unit load beyond Coulomb's, times a weight of the quadrature, at
 * `angle`. */
typedef void (*Gather)(void *sum, double angle, double friction);

/* What the quadrature is over: the slow velocity V [m/s], `waves` of the integrand over a turn, and
 * the load whose kinks it has (NULL for none). */
typedef struct {
    const Bristle *bristle;
    const FastMotion *fast;
    double velocity, waves;
    const VibratingLoad *load;
    Gather gather;
    void *sum;
} Quadrature;

/* A part of the turn with one direction of sliding, and the sine where it begins. `unbent` is what
 * the bristle friction there is beyond the limit `direction` mu. */
typedef struct {
    int direction;
    double begin, end, sine, unbent;
} Arc;

/* Path [m] from where the arc begins. */
static double path(const Quadrature *over, const Arc *arc, double angle, double sine) {
    const FastMotion *fast = over->fast;
    double moved = over->velocity * (angle - arc->begin) - fast->velocity * (sine - arc->sine);
    return arc->direction * moved / fast->frequency;
}

/* Angle in the arc from which the bristle is fully bent. */
static double bent_at(const Quadrature *over, const Arc *arc) {
    double stiffness = over->bristle->stiffness, full = BENT * over->bristle->coefficient;
    double low = arc->begin, high = arc->end;
    if (stiffness * path(over, arc, high, sin(high)) <= full) {
        return high;
    }
    for (int i = 0; i < MOST_BISECTIONS; i++) {
        double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high) {
            break;
        }
        if (stiffness * path(over, arc, middle, sin(middle)) < full) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
}

static void integrate_panel(const Quadrature *over, const Arc *arc, double low, double high) {
    const Bristle *bristle = over->bristle;
    double half = 0.5 * (high - low), mu = bristle->coefficient;
    for (int i = 0; i < NODES; i++) {
        double angle = low + half * (1.0 + NODE[i]), sine = sin(angle), cosine = cos(angle);
        double fade = exp(-bristle->stiffness * path(over, arc, angle, sine) / mu);
        double drag = bristle->damping * (over->velocity - over->fast->velocity * cosine);
        double friction = arc->unbent * fade * (1.0 - arc->direction * drag / mu);
        over->gather(over->sum, angle, WEIGHT[i] * half * friction);
    }
}

/* Panels between edges and kinks, none wider than WIDEST of the normal load. */
static void integrate_arc(const Quadrature *over, const Arc *arc) {
    if (!(fabs(arc->unbent) > EPSILON * over->bristle->coefficient)) {
        return;
    }
    double length = bent_at(over, arc) - arc->begin, low = arc->begin;
    for (int edge = 1; edge < EDGES; edge++) {
        double last = arc->begin + length * EDGE[edge];
        while (low < last) {
            double high = last;
            if (over->load) {
                high = fmin(high, vibrating_load_next_kink(over->load, low));
            }
            double pieces = 1.0 + floor(fabs(over->waves) * (high - low) / WIDEST);
            double width = (high - low) / pieces;
            for (double piece = 0.0; piece < pieces; piece += 1.0) {
                integrate_panel(over, arc, low + piece * width, low + (piece + 1.0) * width);
            }
            low = high;
        }
    }
}

/* Quadrature over both arcs of what the bristle still lacks of being fully bent. The response is
 * periodic: sigma_0 z where the forward arc begins follows from the lengths of both. */
static void integrate_turn(const Quadrature *over, double turning) {
    double stiffness = over->bristle->stiffness, mu = over->bristle->coefficient;
    Arc forward = {1, turning, TAU - turning, sin(turning), 0.0};
    Arc backward = {-1, -turning, turning, -forward.sine, 0.0};
    double forward_length = path(over, &forward, forward.end, sin(forward.end));
    double backward_length = path(over, &backward, backward.end, sin(backward.end));
    double bent_forward = -expm1(-stiffness * forward_length / mu);
    double bent_backward = -expm1(-stiffness * backward_length / mu);
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

typedef struct {
    const VibratingLoad *load;
    double friction;
} LoadedSum;

static void gather_loaded(void *sum, double angle, double friction) {
    LoadedSum *loaded = sum;
    loaded->friction += vibrating_load_at(loaded->load, angle) * friction;
}

double mean_friction(const Bristle *bristle, const FastMotion *fast, const VibratingLoad *load,
                     double turning) {
    VibratingLoad counted = *load;
    if (fabs(vibrating_load_waves(load)) > MOST_WAVES) {
        counted = vibrating_load_flattened(load);
    }
    LoadedSum bent = {&counted, 0.0};
    Quadrature over = {.bristle = bristle, .fast = fast, .load = &counted, .sum = &bent};
    over.velocity = fast->velocity * cos(turning);
    over.waves = vibrating_load_waves(&counted);
    over.gather = gather_loaded;
    integrate_turn(&over, turning);
    double coulomb = bristle->coefficient * vibrating_load_difference(&counted, turning);
    return (coulomb + bent.friction) / TAU;
}

typedef struct {
    double n;
    FrictionMeans means;
} WavySum;

static void gather_wavy(void *sum, double angle, double friction) {
    WavySum *wavy = sum;
    wavy->means.plain += friction;
    if (wavy->n != 0.0) {
        wavy->means.sine += friction * sin(wavy->n * angle);
        wavy->means.cosine += friction * cos(wavy->n * angle);
    }
}

FrictionMeans friction_means(const Bristle *bristle, const FastMotion *fast, double n,
                             double turning) {
    double mu = bristle->coefficient, waves = fabs(n) <= MOST_WAVES ? n : 0.0;
    WavySum sum = {waves, {mu * (TAU - 4.0 * turning), 0.0, 0.0}};
    if (waves != 0.0) {
        sum.means.cosine = -4.0 * mu * sin(n * turning) / n;
    }
    Quadrature over = {.bristle = bristle, .fast = fast, .waves = waves, .sum = &sum};
    over.velocity = fast->velocity * cos(turning);
    over.gather = gather_wavy;
    integrate_turn(&over, turning);
    FrictionMeans means = {sum.means.plain / TAU, sum.means.sine / TAU, sum.means.cosine / TAU};
    return means;
}
