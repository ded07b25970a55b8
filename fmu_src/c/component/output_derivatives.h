/* First derivatives of outputs, at the present moment and the present inputs. */
#ifndef OUTPUT_DERIVATIVES_H
#define OUTPUT_DERIVATIVES_H

#include <stdbool.h>

#include "../base/refusal.h"
#include "../device/moment.h"
#include "../friction/law.h"

/* The right-hand derivative of the output `reference`, per s: 0 for outputs that change only at events and
 * at the ends of periods. `phase_rate` [rad/s] is the derivative of the input `phase`. Refuses variables
 * without derivative. */
bool output_derivative(unsigned reference, const Law *law, const Moment *moment, double phase_rate,
                       double *derivative, Refusal *refusal);

#endif
