/* FMI 2.0: names, and the host's logger. */
#include "fmi2_api.h"
#include "fmi_version.h"

const FmiVersion FMI = {
    .min_reference = 0,
    .reference_offset = 0,
    .states = TERMINATED + 1,
    .state_names = {"instantiated", "initialization mode", "step complete", "terminated"},
    .type_names = {"Real", "Integer", "Boolean", "String"},
    .token = "fmuGUID",
};

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

void fmi2_log(const Host *host, const char *instance_name, Status status, const char *category,
              const char *text) {
    char format[2 * REFUSAL_SIZE];
    double_specials(text, format, sizeof format);
    fmi2CallbackLogger logger = (fmi2CallbackLogger)host->logger;
    logger(host->environment, instance_name, (fmi2Status)status, category, format);
}
