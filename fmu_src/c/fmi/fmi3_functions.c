/* FMI 3.0: functions for an instance as a whole.
 *
 * A refused call returns fmi3Error and leaves the instance as it was, ready for the next call. */
#include <stddef.h>

#include "../component/lifecycle.h"
#include "fmi3_api.h"

static void log_message(const Host *host, const char *instance_name, Status status,
                        const char *category, const char *text) {
    (void)instance_name;
    fmi3LogMessageCallback logger = (fmi3LogMessageCallback)host->logger;
    logger(host->environment, (fmi3Status)status, category, text);
}

Host fmi3_host(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger) {
    return (Host){environment, NULL, NULL, (void (*)(void))logger, log_message};
}

const char *fmi3GetVersion(void) {
    return fmi3Version;
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
    fmi3Boolean visible, fmi3Boolean loggingOn, fmi3Boolean eventModeUsed,
    fmi3Boolean earlyReturnAllowed, const fmi3ValueReference requiredIntermediateVariables[],
    size_t nRequiredIntermediateVariables, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage, fmi3IntermediateUpdateCallback intermediateUpdate) {
    (void)resourcePath, (void)visible, (void)requiredIntermediateVariables;
    (void)intermediateUpdate;
    const char *call = "fmi3InstantiateCoSimulation";
    Host host = fmi3_host(instanceEnvironment, logMessage);
    if (nRequiredIntermediateVariables > 0) {
        Refusal refusal;
        refuse(&refusal, "%s: nRequiredIntermediateVariables = %lu refused: must be 0, there is no "
               "intermediate update", call, (unsigned long)nRequiredIntermediateVariables);
        return refuse_instance(&host, instanceName, &refusal);
    }
    Instance *instance =
        instance_create(&host, call, instanceName, instantiationToken, loggingOn);
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
    return (fmi3Status)set_debug_logging(instance, "fmi3SetDebugLogging", loggingOn, nCategories,
                                         categories);
}

/* The times of the experiment come with the change to initialization mode. */
fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined,
                                       fmi3Float64 tolerance, fmi3Float64 startTime,
                                       fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
    Instance *own = instance;
    Refusal refusal;
    Experiment experiment = {startTime, stopTimeDefined, stopTime, toleranceDefined, tolerance};
    bool done = own != NULL
                && require("enterInitializationMode", own->component.now.lifecycle, INSTANTIATED,
                           &refusal)
                && component_setup_experiment(&own->component, &experiment, &refusal)
                && component_enter_initialization(&own->component, &refusal);
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
    return (fmi3Status)lifecycle_call(instance, component_terminate);
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    return (fmi3Status)instance_reset(instance);
}
