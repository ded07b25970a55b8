/* FMI 3.0 for co-simulation. In this order: an instance and its life cycle, values (all of a call or none), steps and
 * the event mode between them, the complete state.
 *
 * A refused call returns fmi3Error and leaves the instance as it was, ready for the next call.
 *
 * If the host uses event mode and allows early return, a step ends at the first reversal, stick, release, lift-off or
 * touchdown, located to rounding. Otherwise it passes over them. */
#include "fmi3_api.h"
#include "state_access.h"
#include "value_access.h"

static void log_message(const Host *host, const char *instance_name, Status status, const char *category,
                        const char *text) {
    (void)instance_name;
    fmi3LogMessageCallback logger = (fmi3LogMessageCallback)host->logger;
    logger(host->environment, status, category, text);
}

Host fmi3_host(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger) {
    return (Host){environment, NULL, NULL, (void (*)(void))logger, log_message};
}

const char *fmi3GetVersion(void) {
    return fmi3Version;
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instanceName, fmi3String instantiationToken,
                                         fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                         fmi3Boolean eventModeUsed, fmi3Boolean earlyReturnAllowed,
                                         const fmi3ValueReference requiredIntermediateVariables[],
                                         size_t nRequiredIntermediateVariables,
                                         fmi3InstanceEnvironment instanceEnvironment, fmi3LogMessageCallback logMessage,
                                         fmi3IntermediateUpdateCallback intermediateUpdate) {
    (void)resourcePath, (void)visible, (void)requiredIntermediateVariables;
    (void)intermediateUpdate;
    const char *call = "fmi3InstantiateCoSimulation";
    Host host = fmi3_host(instanceEnvironment, logMessage);
    if (nRequiredIntermediateVariables > 0) {
        Refusal refusal;
        refuse(&refusal, "%s: nRequiredIntermediateVariables = %lu refused: must be 0, there is no intermediate update",
               call, (unsigned long)nRequiredIntermediateVariables);
        return refuse_instance(&host, instanceName, &refusal);
    }
    Instance *instance = instance_create(&host, call, instanceName, instantiationToken, loggingOn);
    if (instance != NULL) {
        instance->event_mode_used = eventModeUsed;
        instance->early_return_allowed = earlyReturnAllowed;
    }
    return instance;
}

void fmi3FreeInstance(fmi3Instance instance) {
    instance_free(instance);
}

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[]) {
    return set_debug_logging(instance, "fmi3SetDebugLogging", loggingOn, nCategories, categories);
}

/* The times of the experiment come with the change to initialization mode. */
fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined, fmi3Float64 tolerance,
                                       fmi3Float64 startTime, fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
    Instance *own = instance;
    Refusal refusal;
    Experiment experiment = {startTime, stopTimeDefined ? stopTime : INFINITY, toleranceDefined, tolerance};
    bool done = own != NULL &&
                require("enterInitializationMode", own->component.now.lifecycle, INSTANTIATED, &refusal) &&
                component_setup_experiment(&own->component, &experiment, &refusal) &&
                component_enter_initialization(&own->component, &refusal);
    return answer(own, done, &refusal);
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    Instance *own = instance;
    Refusal refusal;
    bool done = own != NULL && component_exit_initialization(&own->component, &refusal);
    if (done && own->event_mode_used) {
        done = component_enter_event_mode(&own->component, &refusal);
    }
    return answer(own, done, &refusal);
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
    return lifecycle_call(instance, component_terminate);
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    return instance_reset(instance);
}

#define GET_AND_SET(NAME, TYPE) \
    fmi3Status fmi3Get##NAME(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                             size_t nValueReferences, fmi3##NAME values[], size_t nValues) { \
        return values_get(instance, "fmi3Get" #NAME, valueReferences, nValueReferences, (void *)values, nValues, \
                          TYPE); \
    } \
    fmi3Status fmi3Set##NAME(fmi3Instance instance, const fmi3ValueReference valueReferences[], \
                             size_t nValueReferences, const fmi3##NAME values[], size_t nValues) { \
        return values_set(instance, "fmi3Set" #NAME, valueReferences, nValueReferences, (const void *)values, nValues, \
                          TYPE); \
    }

GET_AND_SET(Float64, REAL_TYPE)
GET_AND_SET(Int32, INTEGER_TYPE)
GET_AND_SET(Float32, FLOAT32_TYPE)
GET_AND_SET(Int8, INT8_TYPE)
GET_AND_SET(UInt8, UINT8_TYPE)
GET_AND_SET(Int16, INT16_TYPE)
GET_AND_SET(UInt16, UINT16_TYPE)
GET_AND_SET(UInt32, UINT32_TYPE)
GET_AND_SET(Int64, INT64_TYPE)
GET_AND_SET(UInt64, UINT64_TYPE)
GET_AND_SET(Boolean, BOOLEAN_TYPE)
GET_AND_SET(String, STRING_TYPE)

/* Refuse NULL where the function `call` must write its results. */
static bool results_check(const char *call, bool all_given, Refusal *refusal) {
    return all_given || refuse(refusal, "%s: a null pointer refused: must point to memory for a result", call);
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint, fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *eventHandlingNeeded,
                      fmi3Boolean *terminateSimulation, fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime) {
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *own = instance;
    Refusal refusal;
    if (own == NULL ||
        !results_check("fmi3DoStep", eventHandlingNeeded && terminateSimulation && earlyReturn && lastSuccessfulTime,
                       &refusal)) {
        return answer(own, false, &refusal);
    }
    Component *component = &own->component;
    bool event = false, done;
    if (own->event_mode_used && own->early_return_allowed) {
        done = component_step_to_event(component, currentCommunicationPoint, communicationStepSize, &event, &refusal);
    } else {
        done = component_step(component, currentCommunicationPoint, communicationStepSize, &refusal);
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
    return lifecycle_call(instance, change);
}

fmi3Status fmi3EnterEventMode(fmi3Instance instance) {
    return change_mode(instance, "fmi3EnterEventMode", component_enter_event_mode);
}

fmi3Status fmi3EnterStepMode(fmi3Instance instance) {
    return change_mode(instance, "fmi3EnterStepMode", component_enter_step_mode);
}

/* There is nothing to update at an event: the step that ended there has changed the contact mode. */
fmi3Status fmi3UpdateDiscreteStates(fmi3Instance instance, fmi3Boolean *discreteStatesNeedUpdate,
                                    fmi3Boolean *terminateSimulation, fmi3Boolean *nominalsOfContinuousStatesChanged,
                                    fmi3Boolean *valuesOfContinuousStatesChanged, fmi3Boolean *nextEventTimeDefined,
                                    fmi3Float64 *nextEventTime) {
    Instance *own = instance;
    Refusal refusal;
    bool done = own != NULL &&
                results_check("fmi3UpdateDiscreteStates",
                              discreteStatesNeedUpdate && terminateSimulation && nominalsOfContinuousStatesChanged &&
                                  valuesOfContinuousStatesChanged && nextEventTimeDefined && nextEventTime,
                              &refusal) &&
                require("updateDiscreteStates", own->component.now.lifecycle, EVENT_MODE, &refusal);
    if (done) {
        *discreteStatesNeedUpdate = *terminateSimulation = fmi3False;
        *nominalsOfContinuousStatesChanged = *valuesOfContinuousStatesChanged = fmi3False;
        *nextEventTimeDefined = fmi3False;
        *nextEventTime = 0.0;
    }
    return answer(own, done, &refusal);
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    return state_get(instance, "fmi3GetFMUState", FMUState);
}

/* As events leave nothing to update, an instance without event mode goes on in step mode from a state that had it. */
fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
    Instance *own = instance;
    fmi3Status status = state_set(own, "fmi3SetFMUState", FMUState);
    if (status == fmi3OK && !own->event_mode_used && own->component.now.lifecycle == EVENT_MODE) {
        own->component.now.lifecycle = STEP_COMPLETE;
    }
    return status;
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    return state_free(instance, FMUState);
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size) {
    return state_size(instance, "fmi3SerializedFMUStateSize", FMUState, size);
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState, fmi3Byte serializedState[],
                                 size_t size) {
    return state_write(instance, "fmi3SerializeFMUState", FMUState, serializedState, size);
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[], size_t size,
                                   fmi3FMUState *FMUState) {
    return state_read(instance, "fmi3DeserializeFMUState", serializedState, size, FMUState);
}
