/* The outputs of the interface, each from the present moment and the present inputs. */
#pragma once

#include "../leap/prediction.h"

/* A cache of the predictions of a system at `normal_lead` [rad]; its owner clears it when the system changes. */
typedef struct {
    double normal_lead;
    bool known[QUANTITIES];
    Prediction predictions[QUANTITIES];
} Theory;

/* The output `reference` of the system at this moment; `last_event_time` [s]. */
double output_value(unsigned reference, const System *system, const Moment *moment, double last_event_time,
                    Theory *theory);

/* The right-hand derivative of the output `reference` at the present moment and inputs, per s: 0 for outputs that
 * change only at events and at the ends of periods. `phase_rate` [rad/s] is the derivative of the input `phase`.
 * Refuses variables without derivative. */
bool output_derivative(unsigned reference, const System *system, const Moment *moment, double phase_rate,
                       double *derivative, Refusal *refusal);
