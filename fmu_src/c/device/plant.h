/* The equations of motion (26)-(27) under held inputs, as coefficients of their closed forms.
 *
 * With theta the phase of the drive, chi = psi + phase that of the normal load, s the direction of sliding (0 in
 * flight) and Y the resonator relative to the slider:
 *
 *   slip:   Y'' + 2 decay Y' + stiffness Y = relative_drive sin(theta) + (F + load) / M
 *           (M + m) X'' = (M + m) Re(drive e) - F - load - m Y'',      F = s (F0 + F1 sin(chi))
 *   stick:  Y'' + 2 xi wn Y' + wn^2 Y = A w^2 sin(theta),              X' = 0
 *
 * where e = -i exp(i theta). At fidelity 1 the resonator acts through its steady force (34) alone. */
#pragma once

#include "../base/refusal.h"
#include "device.h"
#include "oscillator.h"

/* Range of chi [rad] in which the contact is lifted, if there is one (`exists`): [0, 2 pi] if there is no normal load
 * at all. */
typedef struct {
    bool exists;
    double first, last;
} FlightWindow;

/* Coefficients under held inputs (SI units; complex numbers are amplitudes of e).
 *
 * At fidelity 1 (and 0) the resonator acts by its steady force only: `slider_mass` is the total mass, `mass_fraction`,
 * `spring` and `damper` are 0, and `resolves_resonator` is false. `holding_drive` is the part of the force on a held
 * slider that follows the drive directly [N].
 *
 * While inputs vary, the load grows by `load_rate` [N/s] and the normal frequency by `normal_rate` [rad/s^2]; both are
 * 0 under held inputs. */
typedef struct {
    double slider_mass, total_mass;              /* M and M + m [kg] */
    double mass_fraction;                        /* r_m = m / (M + m) */
    double drive_frequency, normal_frequency;    /* w and the ratio times w [rad/s] */
    double phase, load;                          /* inputs [rad, N] */
    double load_rate, normal_rate;               /* growth of the load [N/s] and of the normal frequency [rad/s^2] */
    double friction_preload, friction_amplitude; /* F0 and F1 [N] */
    FlightWindow window;                         /* where the contact is lifted */
    Oscillator slip, stick;                      /* the resonator on a sliding and on a held slider */
    Complex drive;                               /* force on the pair per total mass [m/s^2] */
    double relative_drive, base_acceleration;    /* drive of the resonator while sliding and sticking [m/s^2] */
    Complex holding_drive;                       /* direct force on a held slider [N] */
    double spring, damper;                       /* k [N/m] and c [N s/m] */
    bool resolves_resonator;                     /* whether the resonator moves by its own equation */
} Plant;

/* Angle [rad] that the normal load turns by in `t` [s]. */
static inline double turned_by(const Plant *plant, double t) {
    return (plant->normal_frequency + 0.5 * plant->normal_rate * t) * t;
}

/* Whether the load or the normal frequency varies. */
static inline bool is_ramped(const Plant *plant) {
    return plant->load_rate != 0.0 || plant->normal_rate != 0.0;
}

/* The scale of velocities to which tolerances refer: sum [m/s] of the velocity amplitude of the drive, the velocity
 * that friction and load change in a radian of the drive, and the velocities of slider and resonator. */
static inline double velocity_scale(const Plant *plant, const State *state) {
    double w = plant->drive_frequency;
    double load = fabs(plant->load) + fabs(plant->load_rate) / w;
    double forces = plant->friction_preload + plant->friction_amplitude + load;
    Complex swing = complex_of(state->rate, plant->stick.frequency * state->displacement);
    return complex_abs(plant->drive) / w + forces / (plant->total_mass * w) + fabs(state->velocity) +
           plant->mass_fraction * complex_abs(swing);
}

/* Amplitude of the steady force of resonator and direct drive on a held slider [N]; infinite where undamped resonance
 * leaves no steady vibration. */
double held_amplitude(const Device *device);

/* The steady vibration of slider and resonator without friction (32)-(34); all 0 where undamped resonance leaves
 * none. */
typedef struct {
    double velocity;      /* amplitude of the slider's velocity, v_q [m/s] */
    double pair_velocity; /* amplitude of the velocity that the drive force gives to the pair [m/s] */
    double lag;           /* theta_1 [rad] */
    Complex resonator;    /* displacement of the resonator, complex amplitude of e [m] */
} FastVibration;

FastVibration fast_vibration_of(const Device *device);

/* Angle tau at which sliding turns forward [rad] at a slow velocity; 0 or pi where it never reverses. */
double turning_at(double velocity, double fast_velocity);

/* Displacement [m] and velocity [m/s] of `amplitude` e at drive phase `theta` [rad]. */
static inline Response steady_swing(Complex amplitude, double theta, double frequency) {
    SineCosine turn = elementary_sine_cosine(theta);
    double sine = turn.sine, cosine = turn.cosine;
    return (Response){amplitude.re * sine + amplitude.im * cosine,
                      frequency * (amplitude.re * cosine - amplitude.im * sine)};
}

/* Coefficients of the motion of `device` while `inputs` are held. Refuses at fidelity 0 and 1 where the steady force of
 * the resonator is unbounded. */
bool plant_prepare(Plant *plant, const Device *device, const Inputs *inputs, Refusal *refusal);

/* The plant with its slider held: a slider of infinite mass. */
Plant plant_held(const Plant *plant);
