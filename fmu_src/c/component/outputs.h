/* The outputs of the interface, each from the present moment and the present inputs. */
#ifndef SLIDER_OUTPUTS_H
#define SLIDER_OUTPUTS_H

#include <stdbool.h>

#include "../device/moment.h"
#include "../friction/law.h"
#include "../averaged/averaged.h"

/* A cache of the prediction of a law at `normal_lead` [rad]; its owner clears `known` when the law changes. */
typedef struct {
    bool known;
    double normal_lead;
    Averaged averaged;
} Theory;

/* The output `reference` of the law at this moment; `last_event_time` [s]. */
double output_value(unsigned reference, const Law *law, const Moment *moment,
                    double last_event_time, Theory *theory);

#endif
