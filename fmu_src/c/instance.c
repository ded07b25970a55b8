#include "instance.h"

#include <stdlib.h>
#include <string.h>

static const char *const CATEGORIES[CATEGORY_COUNT] = {
    "logStatusWarning", "logStatusDiscard", "logStatusError", "logStatusFatal", "logAll"};

static bool gives_memory(const fmi2CallbackFunctions *host) {
    return host->allocateMemory != NULL && host->freeMemory != NULL;
}

void *host_allocate(const fmi2CallbackFunctions *host, size_t size) {
    return gives_memory(host) ? host->allocateMemory(1, size) : calloc(1, size);
}

void host_free(const fmi2CallbackFunctions *host, void *memory) {
    if (gives_memory(host)) {
        host->freeMemory(memory);
    } else {
        free(memory);
    }
}

void enable_all_messages(Instance *instance, bool enabled) {
    for (int category = 0; category < CATEGORY_COUNT; category++) {
        instance->enabled[category] = enabled;
    }
}

void enable_initial_messages(Instance *instance, bool debugging) {
    enable_all_messages(instance, debugging);
    instance->enabled[STATUS_ERROR] = instance->enabled[STATUS_FATAL] = true;
}

bool enable_messages(Instance *instance, const char *category, Refusal *refusal) {
    for (int known = 0; category != NULL && known < CATEGORY_COUNT; known++) {
        if (strcmp(category, CATEGORIES[known]) == 0) {
            instance->enabled[known] = true;
            return true;
        }
    }
    return refuse(refusal, "fmi2SetDebugLogging: category '%.80s' refused: must be one of %s, %s, "
                  "%s, %s, %s", category == NULL ? "(null)" : category, CATEGORIES[STATUS_WARNING],
                  CATEGORIES[STATUS_DISCARD], CATEGORIES[STATUS_ERROR], CATEGORIES[STATUS_FATAL],
                  CATEGORIES[ALL_MESSAGES]);
}

static Category category_of(fmi2Status status) {
    switch (status) {
    case fmi2Warning:
        return STATUS_WARNING;
    case fmi2Discard:
        return STATUS_DISCARD;
    case fmi2Error:
        return STATUS_ERROR;
    case fmi2Fatal:
        return STATUS_FATAL;
    default:
        return ALL_MESSAGES;
    }
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

void send_message(const fmi2CallbackFunctions *host, const char *instance_name, fmi2Status status,
                  const char *text) {
    if (host->logger == NULL) {
        return;
    }
    char format[2 * REFUSAL_SIZE];
    double_specials(text, format, sizeof format);
    host->logger(host->componentEnvironment, instance_name, status,
                 CATEGORIES[category_of(status)], format);
}

fmi2Status report(const Instance *instance, fmi2Status status, const char *text) {
    if (instance != NULL
        && (instance->enabled[category_of(status)] || instance->enabled[ALL_MESSAGES])) {
        send_message(&instance->host, instance->name, status, text);
    }
    return status;
}

fmi2Status answer(const Instance *instance, bool done, const Refusal *refusal) {
    return done ? fmi2OK : report(instance, fmi2Error, refusal->text);
}
