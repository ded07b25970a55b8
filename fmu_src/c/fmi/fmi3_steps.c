/* FMI 3.0 for co-simulation: steps, and the event mode between them.
 *
 * If the host uses event mode and allows early return, a step ends at the first reversal, stick,
 * release, lift-off or touchdown, located to rounding. Otherwise it passes over them. */
#include "../component/lifecycle.h"
#include "fmi3_api.h"

/* Refuse NULL where the function `call` must write its results. */
static bool results_check(const char *call, bool all_given, Refusal *refusal) {
    return all_given
           || refuse(refusal, "%s: a null pointer refused: must point to memory for a result", call);
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint,
                      fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                      fmi3Boolean *eventHandlingNeeded, fmi3Boolean *terminateSimulation,
                      fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime) {
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *own = instance;
    Refusal refusal;
    if (own == NULL
        || !results_check("fmi3DoStep",
                          eventHandlingNeeded && terminateSimulation && earlyReturn
                              && lastSuccessfulTime, &refusal)) {
        return answer(own, false, &refusal);
    }
    Component *component = &own->component;
    bool event = false, done;
    if (own->event_mode_used && own->early_return_allowed) {
        done = component_step_to_event(component, currentCommunicationPoint, communicationStepSize,
                                       &event, &refusal);
    } else {
        done = component_step(component, currentCommunicationPoint, communicationStepSize,
                              &refusal);
    }
    double end = currentCommunicationPoint + communicationStepSize;
    *eventHandlingNeeded = event;
    *terminateSimulation = fmi3False;
    *earlyReturn = event && component->now.time < end;
    *lastSuccessfulTime = component->now.time;
    return answer(own, done, &refusal);
}

/* Change to or from event mode; refused if the host announced that it does not use it. */
static fmi3Status change_mode(Instance *instance, const char *call,
                              bool (*change)(Component *component, Refusal *refusal)) {
    if (instance != NULL && !instance->event_mode_used) {
        Refusal refusal;
        refuse(&refusal, "%s refused: eventModeUsed = false; must be true at instantiation", call);
        return answer(instance, false, &refusal);
    }
    return (fmi3Status)lifecycle_call(instance, change);
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    return change_mode(instance, "fmi3EnterEventMode", component_enter_event_mode);
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    return change_mode(instance, "fmi3EnterStepMode", component_enter_step_mode);
}

/* There is nothing to update at an event: the step that ended there has changed the contact mode. */
fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation,
                                    fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged,
                                    fmi3Boolean *nextEventTimeDefined,
                                    fmi3Float64 *nextEventTime) {
    Instance *own = instance;
    Refusal refusal;
    bool done = own != NULL
                && results_check("fmi3UpdateDiscreteStates",
                                 discreteStatesNeedUpdate && terminateSimulation
                                     && nominalsOfContinuousStatesChanged
                                     && valuesOfContinuousStatesChanged && nextEventTimeDefined
                                     && nextEventTime, &refusal)
                && require("updateDiscreteStates", own->component.now.lifecycle, EVENT_MODE,
                           &refusal);
    if (done) {
        *discreteStatesNeedUpdate = *terminateSimulation = fmi3False;
        *nominalsOfContinuousStatesChanged = *valuesOfContinuousStatesChanged = fmi3False;
        *nextEventTimeDefined = fmi3False;
        *nextEventTime = 0.0;
    }
    return answer(own, done, &refusal);
}
