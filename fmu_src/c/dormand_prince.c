#include "dormand_prince.h"

#include "elementary.h"

/* A step tried: `change` of the velocity and its estimated `error` [m/s], displacement `moved` [m], and
 * the acceleration `last` at the end [m/s^2]. */
typedef struct {
    double change, moved, error, last;
} Stage;

static Stage try_step(AccelerationFunction acceleration, const void *motion, double t, double v,
                      double h, double k1) {
    double k2 = acceleration(motion, t + h / 5, v + h * k1 / 5);
    double k3 = acceleration(motion, t + 3 * h / 10, v + h * (3 * k1 + 9 * k2) / 40);
    double k4 = acceleration(motion, t + 4 * h / 5,
                             v + h * (44 * k1 / 45 - 56 * k2 / 15 + 32 * k3 / 9));
    double k5 = acceleration(motion, t + 8 * h / 9,
                             v + h * (19372 * k1 / 6561 - 25360 * k2 / 2187 + 64448 * k3 / 6561 -
                                      212 * k4 / 729));
    double k6 = acceleration(motion, t + h,
                             v + h * (9017 * k1 / 3168 - 355 * k2 / 33 + 46732 * k3 / 5247 +
                                      49 * k4 / 176 - 5103 * k5 / 18656));
    Stage stage;
    stage.change = h * (35 * k1 / 384 + 500 * k3 / 1113 + 125 * k4 / 192 - 2187 * k5 / 6784 +
                        11 * k6 / 84);
    stage.last = acceleration(motion, t + h, v + stage.change);
    stage.error = h * fabs(71 * k1 / 57600 - 71 * k3 / 16695 + 71 * k4 / 1920 -
                           17253 * k5 / 339200 + 22 * k6 / 525 - stage.last / 40);
    /* The weights of the fifth order, applied to the velocities at the stages. */
    stage.moved = h * v + h * h * (35 * k1 / 384 + 50 * k3 / 159 + 25 * k4 / 192 -
                                   243 * k5 / 6784);
    return stage;
}

Reached integrate(AccelerationFunction acceleration, const void *motion, Reached from, double end,
                  double tolerance, double longest, int max_steps) {
    Reached now = from;
    double first = acceleration(motion, now.t, now.velocity);
    for (int count = 0; count < max_steps && now.t < end && isfinite(now.velocity); count++) {
        double left = end - now.t, h = fmin(fmin(now.step, longest), left);
        now.tried++;
        Stage stage = try_step(acceleration, motion, now.t, now.velocity, h, first);
        if (!(stage.error > tolerance)) {
            now.moved += stage.moved;
            now.velocity += stage.change;
            now.t = h < left ? now.t + h : end;
            first = stage.last;
        }
        double growth = stage.error > 0.0 ? 0.9 * pow(tolerance / stage.error, 0.2) : 5.0;
        now.step = h * fmin(5.0, fmax(0.2, growth));
    }
    return now;
}
