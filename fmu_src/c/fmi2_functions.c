/* FMI 2.0: functions for an instance as a whole.
 *
 * A refused call returns fmi2Error and leaves the instance as it was, ready for the next call. It
 * never returns fmi2Discard, which hosts take for a request to end the run early. */
#include <string.h>

#include "instance.h"
#include "model_guid.h"

const char *fmi2GetTypesPlatform(void) {
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void) {
    return fmi2Version;
}

static bool instantiation_check(const char *name, fmi2Type type, const char *guid,
                                Refusal *refusal) {
    if (name == NULL || name[0] == '\0') {
        return refuse(refusal, "fmi2Instantiate: instanceName refused: it is %s; must be a name",
                      name == NULL ? "a null pointer" : "empty");
    }
    if (type != fmi2CoSimulation) {
        return refuse(refusal, "fmi2Instantiate: fmuType = %d refused: must be %d, "
                      "fmi2CoSimulation", (int)type, (int)fmi2CoSimulation);
    }
    if (guid == NULL || strcmp(guid, MODEL_GUID) != 0) {
        return refuse(refusal, "fmi2Instantiate: fmuGUID = '%.80s' refused: must be '%s'; the "
                      "model description is of another build",
                      guid == NULL ? "(null)" : guid, MODEL_GUID);
    }
    return true;
}

/* Report a refusal even with logging off: the host has no other source for the reason. */
fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean loggingOn) {
    (void)fmuResourceLocation;
    (void)visible;
    if (functions == NULL) {
        return NULL;
    }
    const char *name = instanceName == NULL ? "" : instanceName;
    Instance *instance = NULL;
    Refusal refusal;
    if (instantiation_check(instanceName, fmuType, fmuGUID, &refusal)) {
        size_t length = strlen(name);
        instance = host_allocate(functions, sizeof *instance + length + 1);
        if (instance != NULL) {
            memset(instance, 0, sizeof *instance);
            memcpy(instance->name, name, length + 1);
            instance->host = *functions;
            enable_initial_messages(instance, loggingOn != fmi2False);
            component_reset(&instance->component);
            return instance;
        }
        refuse(&refusal, "fmi2Instantiate: no memory for an instance");
    }
    send_message(functions, name, fmi2Error, refusal.text);
    return NULL;
}

void fmi2FreeInstance(fmi2Component c) {
    if (c != NULL) {
        fmi2CallbackFunctions host = ((Instance *)c)->host;
        host_free(&host, c);
    }
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
    Instance *instance = c;
    Refusal refusal;
    if (instance == NULL) {
        return fmi2Error;
    }
    bool before[CATEGORY_COUNT];
    memcpy(before, instance->enabled, sizeof before);
    bool known = nCategories <= CATEGORY_COUNT && (nCategories == 0 || categories != NULL);
    if (!known) {
        refuse(&refusal, "fmi2SetDebugLogging: nCategories = %lu refused: must be from 0 to %d, "
               "with as many categories", (unsigned long)nCategories, CATEGORY_COUNT);
    }
    enable_all_messages(instance, loggingOn != fmi2False && nCategories == 0);
    for (size_t i = 0; known && i < nCategories; i++) {
        known = enable_messages(instance, categories[i], &refusal);
    }
    if (!known) {
        memcpy(instance->enabled, before, sizeof before);
    } else if (loggingOn == fmi2False) {
        enable_all_messages(instance, false);
    }
    return answer(instance, known, &refusal);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance,
                               fmi2Real startTime, fmi2Boolean stopTimeDefined,
                               fmi2Real stopTime) {
    Instance *instance = c;
    Refusal refusal;
    Experiment experiment = {startTime, stopTimeDefined != fmi2False, stopTime,
                             toleranceDefined != fmi2False, tolerance};
    bool done = instance != NULL
                && component_setup_experiment(&instance->component, &experiment, &refusal);
    return answer(instance, done, &refusal);
}

static fmi2Status change_lifecycle(fmi2Component c, bool (*change)(Component *, Refusal *)) {
    Instance *instance = c;
    Refusal refusal;
    bool done = instance != NULL && change(&instance->component, &refusal);
    return answer(instance, done, &refusal);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    return change_lifecycle(c, component_enter_initialization);
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    return change_lifecycle(c, component_exit_initialization);
}

fmi2Status fmi2Terminate(fmi2Component c) {
    return change_lifecycle(c, component_terminate);
}

fmi2Status fmi2Reset(fmi2Component c) {
    Instance *instance = c;
    if (instance == NULL) {
        return fmi2Error;
    }
    component_reset(&instance->component);
    instance->last_step = fmi2OK;
    return fmi2OK;
}
