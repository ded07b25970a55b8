/* FMI 3.0: names, and the host's logger. */
#include <stddef.h>

#include "fmi3_api.h"
#include "fmi_version.h"

/* Reference 1 is the time; the variables of the table follow. */
const FmiVersion FMI = {
    .min_reference = 1,
    .reference_offset = 2,
    .states = EVENT_MODE + 1,
    .state_names = {"instantiated", "initialization mode", "step mode", "terminated",
                    "event mode"},
    .type_names = {"Float64", "Int32", "Boolean", "String", "Float32", "Int8", "UInt8", "Int16",
                   "UInt16", "UInt32", "Int64", "UInt64", "Binary", "Clock"},
    .token = "instantiationToken",
};

static void log_message(const Host *host, const char *instance_name, Status status,
                        const char *category, const char *text) {
    (void)instance_name;
    fmi3LogMessageCallback logger = (fmi3LogMessageCallback)host->logger;
    logger(host->environment, (fmi3Status)status, category, text);
}

Host fmi3_host(fmi3InstanceEnvironment environment, fmi3LogMessageCallback logger) {
    return (Host){environment, NULL, NULL, (void (*)(void))logger, log_message};
}
