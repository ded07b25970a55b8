/* A system: a device under held inputs, with all that follows from these alone, and the row of functions of its
 * friction.
 *
 * A new law of friction is a file that ends with its row, and an entry in system.c. */
#pragma once

#include "../device/split_slide.h"
#include "bristle.h"

/* The caches outlive the system; the systems of one instance share them. They are NULL where the motion does
 * without. */
typedef struct System {
    Device device;                      /* the parameters; `fidelity` is that of what moves */
    Inputs inputs;                      /* phase [rad], load [N] and frequency ratio [1], at the start if they grow */
    double middle_ratio;                /* frequency ratio [1] in the middle of a step in which it grows */
    Plant plant;                        /* coefficients of the equations of motion */
    bool splits;                        /* whether sliding and flight use `split` */
    Split split;                        /* their closed form, split into momentum and free oscillation */
    double arc;                         /* longest segment [s]: after that a motion begins anew from its state */
    Bristle bristle;                    /* what friction needs */
    FastVibration fast;                 /* the steady vibration */
    const struct FrictionLaw *friction; /* row of the friction law */
    const struct Motion *motion;        /* row of the kind of motion, see motion.h */
    struct FrictionTables *tables;      /* cache: mean friction of bristles */
    struct BendingTables *bending;      /* cache: panels of bending bristles */
} System;

struct Segment; /* see segment.h */

typedef struct FrictionLaw {
    /* Prepare the bristle. Refuses a device for which the law is not defined. */
    bool (*prepare)(const Device *device, Bristle *bristle, Refusal *refusal);

    /* Contact mode under the held inputs. */
    int (*mode)(const System *system, const Moment *moment);

    /* Friction force [N] on the slider in contact mode `mode`, positive against +X. */
    double (*force)(const System *system, const Moment *moment, int mode);

    /* Begin the segment that starts at `now`, in the contact mode of `now`, to be followed for up to `longest` [s]. */
    void (*begin)(struct Segment *segment, const System *system, const Moment *now, double longest);

    /* Change from the end of a finished segment to the next contact mode; `switches` is true where the contact lifts or
     * touches down there. */
    void (*enter_next_mode)(const struct Segment *segment, const System *system, Moment *now, bool switches);
} FrictionLaw;

extern const FrictionLaw COULOMB, LUGRE;

/* Prepare all of a system but its motion and caches, by the number `friction_law` of the device. Refuses where device
 * and friction law do not fit; `system` is then undefined. */
bool system_prepare(System *system, const Device *device, const Inputs *inputs, Refusal *refusal);

/* Contact mode by load and velocity alone: lifted, or the direction of sliding; STICK at rest. */
int mode_by_velocity(const System *system, const Moment *moment);

/* Change phase [rad] and load [N] of a system; nothing else prepared depends on these. */
void system_change(System *system, double phase, double load);

/* Inputs that grow: the frequency `ratio` at first, and the rates of load [N/s] and ratio [1/s]. */
typedef struct {
    double ratio, load_rate, ratio_rate;
} Ramp;

/* Let inputs grow for `duration` [s]. The system must have been prepared with the frequency ratio in the middle of that
 * time. */
void system_ramp(System *system, const Ramp *ramp, double duration);

/* The slow velocity V = X' + r Y' + D / (Mt w) cos(theta) [m/s] of a state at drive phase `theta` [rad], with D the
 * amplitude of the drive force on the pair: friction and load alone change it, Mt V' = -F - load. */
double slow_velocity(const System *system, const State *state, double theta);

/* The system `t` [s] later. */
System system_after(const System *system, double t);
