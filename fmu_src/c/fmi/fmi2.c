/* FMI 2.0 for co-simulation. In this order: an instance and its life cycle, values (all of a call or none), steps and
 * their status, the complete state.
 *
 * A refused call returns fmi2Error and leaves the instance as it was, ready for the next call. Only status functions
 * return fmi2Discard, which hosts of other calls take for a request to end the run early. */
#include "fmi2_api.h"
#include "state_access.h"
#include "value_access.h"

const char *fmi2GetTypesPlatform(void) {
    return fmi2TypesPlatform;
}

const char *fmi2GetVersion(void) {
    return fmi2Version;
}

/* The logger takes a format, in which % and # have a meaning unless they are doubled. */
static void double_specials(const char *text, char *format, size_t size) {
    size_t length = 0;
    for (; *text != '\0' && length + 2 < size; text++) {
        format[length++] = *text;
        if (*text == '%' || *text == '#') {
            format[length++] = *text;
        }
    }
    format[length] = '\0';
}

static void log_message(const Host *host, const char *instance_name, Status status, const char *category,
                        const char *text) {
    char format[2 * REFUSAL_SIZE];
    double_specials(text, format, sizeof format);
    fmi2CallbackLogger logger = (fmi2CallbackLogger)host->logger;
    logger(host->environment, instance_name, status, category, format);
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation, const fmi2CallbackFunctions *functions,
                              fmi2Boolean visible, fmi2Boolean loggingOn) {
    (void)fmuResourceLocation;
    (void)visible;
    if (functions == NULL) {
        return NULL;
    }
    const Host host = {
        .environment = functions->componentEnvironment,
        .allocate = functions->allocateMemory,
        .release = functions->freeMemory,
        .logger = (void (*)(void))functions->logger,
        .log = log_message,
    };
    if (fmuType != fmi2CoSimulation) {
        Refusal refusal;
        refuse(&refusal, "fmi2Instantiate: fmuType = %d refused: must be %d, fmi2CoSimulation", (int)fmuType,
               (int)fmi2CoSimulation);
        return refuse_instance(&host, instanceName, &refusal);
    }
    return instance_create(&host, "fmi2Instantiate", instanceName, fmuGUID, loggingOn != fmi2False);
}

void fmi2FreeInstance(fmi2Component c) {
    instance_free(c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
    return set_debug_logging(c, "fmi2SetDebugLogging", loggingOn != fmi2False, nCategories, categories);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance, fmi2Real startTime,
                               fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
    Instance *instance = c;
    Refusal refusal;
    Experiment experiment = {startTime, stopTimeDefined ? stopTime : INFINITY, toleranceDefined != fmi2False,
                             tolerance};
    bool done = instance != NULL && component_setup_experiment(&instance->component, &experiment, &refusal);
    return answer(instance, done, &refusal);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    return lifecycle_call(c, component_enter_initialization);
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    return lifecycle_call(c, component_exit_initialization);
}

fmi2Status fmi2Terminate(fmi2Component c) {
    return lifecycle_call(c, component_terminate);
}

fmi2Status fmi2Reset(fmi2Component c) {
    return instance_reset(c);
}

#define GET_AND_SET(NAME, TYPE) \
    fmi2Status fmi2Get##NAME(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, fmi2##NAME value[]) { \
        return values_get(c, "fmi2Get" #NAME, vr, nvr, (void *)value, nvr, TYPE); \
    } \
    fmi2Status fmi2Set##NAME(fmi2Component c, const fmi2ValueReference vr[], size_t nvr, const fmi2##NAME value[]) { \
        return values_set(c, "fmi2Set" #NAME, vr, nvr, (const void *)value, nvr, TYPE); \
    }

GET_AND_SET(Real, REAL_TYPE)
GET_AND_SET(Integer, INTEGER_TYPE)
GET_AND_SET(Boolean, BOOLEAN_TYPE)
GET_AND_SET(String, STRING_TYPE)

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint, fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *instance = c;
    Refusal refusal;
    if (instance == NULL) {
        return fmi2Error;
    }
    bool done = component_step(&instance->component, currentCommunicationPoint, communicationStepSize, &refusal);
    instance->last_step = answer(instance, done, &refusal);
    return instance->last_step;
}

/* A status that there is not is refused with fmi2Discard: FMI 2.0 demands that, and it ends no run. */
#define GET_STATUS(NAME, TYPE, KIND, VALUE) \
    fmi2Status fmi2Get##NAME(fmi2Component c, const fmi2StatusKind s, TYPE *value) { \
        if (c == NULL || value == NULL) { \
            return report(c, fmi2Error, "fmi2Get" #NAME ": value refused: null pointer; must point to memory"); \
        } \
        if (s != KIND) { \
            return report(c, fmi2Discard, "fmi2Get" #NAME ": the kind must be " #KIND); \
        } \
        *value = VALUE; \
        return fmi2OK; \
    }

GET_STATUS(Status, fmi2Status, fmi2DoStepStatus, ((const Instance *)c)->last_step)
GET_STATUS(RealStatus, fmi2Real, fmi2LastSuccessfulTime, ((const Instance *)c)->component.now.time)
GET_STATUS(BooleanStatus, fmi2Boolean, fmi2Terminated, fmi2False)

#define NO_STATUS(NAME, TYPE, REASON) \
    fmi2Status fmi2Get##NAME(fmi2Component c, const fmi2StatusKind s, TYPE *value) { \
        (void)s; \
        return report(c, c == NULL || value == NULL ? fmi2Error : fmi2Discard, "fmi2Get" #NAME ": " REASON); \
    }

NO_STATUS(IntegerStatus, fmi2Integer, "there is no such status")
NO_STATUS(StringStatus, fmi2String, "no step is ever pending")

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    return state_get(c, "fmi2GetFMUstate", FMUstate);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
    return state_set(c, "fmi2SetFMUstate", FMUstate);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    return state_free(c, FMUstate);
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size) {
    return state_size(c, "fmi2SerializedFMUstateSize", FMUstate, size);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[], size_t size) {
    return state_write(c, "fmi2SerializeFMUstate", FMUstate, serializedState, size);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate) {
    return state_read(c, "fmi2DeSerializeFMUstate", serializedState, size, FMUstate);
}
