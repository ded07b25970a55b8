#include "taylor_slide.h"

#include "../base/elementary.h"

/* 1 / k: divisions would take a good part of the time. */
static const double INVERSE[TAYLOR_TERMS + 1] = {
    0.0,      1.0,      1.0 / 2,  1.0 / 3,  1.0 / 4,  1.0 / 5,  1.0 / 6,  1.0 / 7,
    1.0 / 8,  1.0 / 9,  1.0 / 10, 1.0 / 11, 1.0 / 12, 1.0 / 13, 1.0 / 14, 1.0 / 15,
    1.0 / 16, 1.0 / 17, 1.0 / 18, 1.0 / 19, 1.0 / 20, 1.0 / 21, 1.0 / 22, 1.0 / 23,
};

/* i angle z: the next coefficient of a turning amplitude. */
static Complex turned(Complex z, double angle) {
    return complex_of(-z.im * angle, z.re * angle);
}

/* Adds the contribution of coefficient k to the later terms of the product a b, without those of the first
 * coefficients. Processors compute these independent sums in parallel. */
static void push_product(double *product, const double *a, const double *b, int k) {
    int end = k < TAYLOR_ORDER - k ? k : TAYLOR_ORDER - k;
    for (int i = 1; i < end; i++) {
        product[k + i] += a[k] * b[i] + b[k] * a[i];
    }
    if (2 * k < TAYLOR_ORDER) {
        product[2 * k] += a[k] * b[k];
    }
}

static double value(const double *coefficients, double t) {
    double total = 0.0;
    for (int k = TAYLOR_ORDER; k >= 0; k--) {
        total = total * t + coefficients[k];
    }
    return total;
}

/* A velocity is measured by the first terms of its series. Below MUCH_SMALLER of the scale to which the tolerance
 * refers a series is cut shorter, to keep the tolerance relative to the velocity, but not for less than
 * NEGLIGIBLE_MOTION [m/s]. */
#define MUCH_SMALLER 0.1
#define NEGLIGIBLE_MOTION 1e-200
enum { FIRST_TERMS = 5 };

/* How far a series holds [s]: up to where one of its last two terms reaches the tolerance; at rest, where nothing
 * moves, at any time. */
static double series_reach(const double *coefficients, double tolerance) {
    double last = fabs(coefficients[TAYLOR_ORDER]), before = fabs(coefficients[TAYLOR_ORDER - 1]);
    if (fmax(last, before) == 0.0) {
        return INFINITY;
    }
    double lower = tolerance / fmax(before, SMALLEST), higher = tolerance / fmax(last, SMALLEST);
    return exp(fmin(INVERSE[TAYLOR_ORDER - 1] * log(lower), INVERSE[TAYLOR_ORDER] * log(higher)));
}

/* How far the series of a velocity holds [s] if its last terms may reach `tolerance` times `scale` [m/s] or, if that is
 * much less, times the velocity itself. */
static double reach_of(const double *coefficients, double tolerance, double scale) {
    double reach = series_reach(coefficients, tolerance * scale), size = 0.0;
    for (int k = FIRST_TERMS - 1; k >= 0 && reach < INFINITY; k--) {
        size = size * reach + fabs(coefficients[k]);
    }
    bool is_slow = reach < INFINITY && size < MUCH_SMALLER * scale;
    return is_slow ? series_reach(coefficients, tolerance * fmax(size, NEGLIGIBLE_MOTION)) : reach;
}

/* Coefficients of the vibrating part of the friction limit, from its complex amplitude `normal` [N] on: c[k + 1] = i (q
 * c[k] + chirp c[k - 1]) / (k + 1). */
static void expand_normal(Complex normal, double q, double chirp, double limit[TAYLOR_ORDER]) {
    Complex before = complex_of(0.0, 0.0);
    for (int k = 0; k < TAYLOR_ORDER; k++) {
        Complex next = turned(normal, q * INVERSE[k + 1]);
        limit[k] = normal.re;
        if (chirp != 0.0) {
            next = complex_add(next, turned(before, chirp * INVERSE[k + 1]));
            before = normal;
        }
        normal = next;
    }
}

void taylor_slide_begin(TaylorSlide *slide, const Plant *plant, const Bristle *bristle, int direction,
                        const Moment *now, const Phasors *start, double tolerance) {
    static const Bristle BENT = {1.0, 0.0, 0.0};
    bool bends = bristle != NULL;
    int sign = now->mode == LIFTED ? 0 : direction;
    double friction = bends ? now->bristle : sign;
    bristle = bends ? bristle : &BENT;
    double w = plant->drive_frequency, q = plant->normal_frequency, mu = bristle->coefficient;
    double bend = (mu - sign * friction) / mu, share = friction / mu;
    double drag = bristle->damping / mu, rate_factor = -sign * bristle->stiffness / mu;
    double per_mass = 1.0 / plant->slider_mass, spring = plant->spring, damper = plant->damper;
    double stiffness = plant->stick.stiffness, damping = 2.0 * plant->stick.decay;
    Complex hold = plant->holding_drive, e = complex_of(0.0, -1.0);
    Complex drive = complex_mul(e, start->drive);
    Complex normal = complex_scale(plant->friction_amplitude, complex_mul(e, normal_phasor(plant, start)));
    double *v = slide->velocity, *y = slide->displacement, *u = slide->rate;
    double limit[TAYLOR_ORDER], decay[TAYLOR_TERMS];
    double passed[TAYLOR_TERMS] = {0.0}, resisting[TAYLOR_TERMS] = {0.0};
    double load = plant->load, lost = 0.0, sprung = damper * now->state.rate + spring * now->state.displacement;
    expand_normal(normal, q, plant->normal_rate, limit);
    limit[0] += plant->friction_preload;
    slide->direction = direction;
    slide->rests = now->mode == STICK && direction == 0;
    slide->resonates = plant->resolves_resonator;
    slide->least = plant->friction_preload - plant->friction_amplitude;
    v[0] = now->state.velocity;
    y[0] = now->state.displacement;
    u[0] = now->state.rate;
    decay[0] = 1.0;
    for (int k = 0; k < TAYLOR_ORDER; k++) {
        double step = INVERSE[k + 1];
        double product = k == 0 ? v[0] : passed[k] + v[0] * decay[k] + v[k];
        double bent = drag * product + sign * lost;
        double pull = hold.re * drive.re - hold.im * drive.im - load + sprung;
        double force = slide->rests ? pull : share * limit[k] + bend * (resisting[k] + limit[0] * bent);
        double acceleration = (pull - force) * per_mass;
        slide->force[k] = force;
        v[k + 1] = acceleration * step;
        if (slide->resonates) {
            double swing = plant->base_acceleration * drive.re - damping * u[k] - stiffness * y[k];
            u[k + 1] = (swing - acceleration) * step;
            y[k + 1] = u[k] * step;
            sprung = damper * u[k + 1] + spring * y[k + 1];
        }
        decay[k + 1] = rate_factor * product * step;
        if (bends) {
            for (int i = 1; i < TAYLOR_ORDER - k; i++) {
                resisting[k + i] += bent * limit[i];
            }
            push_product(passed, v, decay, k + 1);
        }
        lost = -decay[k + 1];
        load = k == 0 ? plant->load_rate : 0.0;
        drive = turned(drive, w * step);
    }
    double scale = velocity_scale(plant, &now->state);
    slide->reach = reach_of(v, tolerance, scale);
    if (slide->resonates) {
        double weight = plant->mass_fraction > 0.0 ? plant->mass_fraction : 1.0;
        slide->reach = fmin(slide->reach, reach_of(u, tolerance, scale / weight));
    }
    for (int i = 0; i < 2 && slide->rests; i++) {
        double *margin = slide->margin[i];
        for (int k = 0; k < TAYLOR_ORDER; k++) {
            margin[k] = i == 0 ? limit[k] - slide->force[k] : limit[k] + slide->force[k];
        }
        margin[TAYLOR_ORDER] = 0.0; /* forces have a term less than velocities */
        slide->reach = fmin(slide->reach, series_reach(margin, tolerance * scale * plant->total_mass * w));
    }
}

bool taylor_slide_departs(const TaylorSlide *slide) {
    for (int k = 0; k < TAYLOR_TERMS; k++) {
        if (slide->velocity[k] != 0.0) {
            return slide->direction * slide->velocity[k] >= 0.0;
        }
    }
    return true;
}

static Signal signal_at(void *motion, double t) {
    const TaylorSignal *signal = motion;
    double total = 0.0, slope = 0.0;
    for (int k = TAYLOR_ORDER; k >= 0; k--) {
        slope = slope * t + total;
        total = total * t + signal->coefficients[k];
    }
    return (Signal){signal->sign * total, signal->sign * slope, signal->bound};
}

/* Watch `sign` times a series up to `horizon` [s]. */
static Watch watch_series(TaylorSignal *signal, const double *coefficients, int sign, double horizon) {
    double curvature = 0.0, total = 0.0;
    for (int k = TAYLOR_ORDER; k >= 0; k--) {
        double part = fabs(coefficients[k]);
        total = total * horizon + part;
        if (k >= 2) {
            curvature = curvature * horizon + k * (k - 1) * part;
        }
    }
    *signal = (TaylorSignal){coefficients, sign, curvature};
    return (Watch){signal_at, signal, 4.0 * EPSILON * total, 1.0 / horizon};
}

double taylor_slide_departure(const TaylorSlide *slide, double horizon) {
    double bound = 0.0;
    for (int k = TAYLOR_ORDER; k >= 3; k--) {
        bound = bound * horizon + k * (k - 1) * (k - 2) * fabs(slide->velocity[k]);
    }
    return 3.0 * fmax(0.0, slide->direction * 2.0 * slide->velocity[2]) / fmax(bound, SMALLEST);
}

int taylor_slide_watches(TaylorSlide *slide, double horizon, Watch watches[2]) {
    double force = 0.0;
    if (!slide->rests) {
        watches[0] = watch_series(&slide->watched[0], slide->velocity, slide->direction, horizon);
        return slide->direction != 0;
    }
    for (int k = TAYLOR_ORDER - 1; k >= 0; k--) {
        force = force * horizon + fabs(slide->force[k]);
    }
    if (force == 0.0 || force < 0.999999 * slide->least) {
        return 0;
    }
    watches[0] = watch_series(&slide->watched[0], slide->margin[0], 1, horizon);
    watches[1] = watch_series(&slide->watched[1], slide->margin[1], 1, horizon);
    /* Margins are differences of numbers as large as the larger one. */
    watches[0].noise = watches[1].noise = fmax(watches[0].noise, watches[1].noise);
    return 2;
}

/* Work of friction [J] after `t` [s]: the integral of the product of force and velocity. */
static double work_until(const TaylorSlide *slide, double t) {
    double power[TAYLOR_ORDER] = {0.0}, total = 0.0;
    for (int i = 0; i < TAYLOR_ORDER; i++) {
        for (int k = 0; k < TAYLOR_ORDER - i; k++) {
            power[i + k] += slide->force[i] * slide->velocity[k];
        }
    }
    for (int k = TAYLOR_ORDER - 1; k >= 0; k--) {
        total = total * t + power[k] * INVERSE[k + 1];
    }
    return total * t;
}

Place taylor_slide_place(const TaylorSlide *slide, double t, bool counts_work) {
    Place place = {.state = {value(slide->velocity, t), slide->displacement[0], slide->rate[0]}};
    if (slide->resonates) {
        place.state.displacement = value(slide->displacement, t);
        place.state.rate = value(slide->rate, t);
    }
    double travel = 0.0;
    for (int k = TAYLOR_ORDER; k >= 0; k--) {
        travel = travel * t + slide->velocity[k] * INVERSE[k + 1];
    }
    place.passed = (Passage){travel * t, counts_work && !slide->rests ? work_until(slide, t) : 0.0};
    return place;
}
