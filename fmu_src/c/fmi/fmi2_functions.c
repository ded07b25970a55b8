/* FMI 2.0: functions for an instance as a whole.
 *
 * A refused call returns fmi2Error and leaves the instance as it was, ready for the next call. It
 * never returns fmi2Discard, which hosts take for a request to end the run early. */
#include "fmi2_api.h"

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
    logger(host->environment, instance_name, (fmi2Status)status, category, format);
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean loggingOn) {
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
        refuse(&refusal, "fmi2Instantiate: fmuType = %d refused: must be %d, fmi2CoSimulation",
               (int)fmuType, (int)fmi2CoSimulation);
        return refuse_instance(&host, instanceName, &refusal);
    }
    return instance_create(&host, "fmi2Instantiate", instanceName, fmuGUID,
                           loggingOn != fmi2False);
}

void fmi2FreeInstance(fmi2Component c) {
    instance_free(c);
}

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
    return (fmi2Status)set_debug_logging(c, "fmi2SetDebugLogging", loggingOn != fmi2False, nCategories,
                                         categories);
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

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    return (fmi2Status)lifecycle_call(c, component_enter_initialization);
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    return (fmi2Status)lifecycle_call(c, component_exit_initialization);
}

fmi2Status fmi2Terminate(fmi2Component c) {
    return (fmi2Status)lifecycle_call(c, component_terminate);
}

fmi2Status fmi2Reset(fmi2Component c) {
    return (fmi2Status)instance_reset(c);
}
