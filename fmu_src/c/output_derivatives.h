/* First derivatives of outputs, at the present moment and the present inputs. */
#ifndef OUTPUT_DERIVATIVES_H
#define OUTPUT_DERIVATIVES_H

#include <stdbool.h>

#include "law.h"
#include "moment.h"
#include "refusal.h"

/* The derivative of the output `reference`, per s, towards later times: 0 for outputs that change at
 * events and at the ends of periods only. `phase_rate` [rad/s] is that of the input. Refuses variables
 * that have none. */
bool output_derivative(unsigned reference, const Law *law, const Moment *moment, double phase_rate,
                       double *derivative, Refusal *refusal);

#endif
