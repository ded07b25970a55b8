#include "instance.h"

#include <stdlib.h>
#include <string.h>

#include "../component/model_guid.h"

static const char *const CATEGORIES[STATUSES] = {"logAll", "logStatusWarning", "logStatusDiscard", "logStatusError",
                                                 "logStatusFatal"};

static bool gives_memory(const Host *host) {
    return host->allocate != NULL && host->release != NULL;
}

void *host_allocate(const void *host, size_t size) {
    const Host *own = host;
    void *memory = gives_memory(own) ? own->allocate(1, size) : calloc(1, size);
    return memory != NULL ? memset(memory, 0, size) : NULL;
}

void host_free(const void *host, void *memory) {
    const Host *own = host;
    if (memory == NULL) {
        return;
    }
    if (gives_memory(own)) {
        own->release(memory);
    } else {
        free(memory);
    }
}

static void send_message(const Host *host, const char *name, Status status, const char *text) {
    if (host->logger != NULL) {
        host->log(host, name, status, CATEGORIES[status], text);
    }
}

void *refuse_instance(const Host *host, const char *name, const Refusal *refusal) {
    send_message(host, name == NULL ? "" : name, STATUS_ERROR, refusal->text);
    return NULL;
}

static bool instance_check(const char *call, const char *name, const char *token, Refusal *refusal) {
    if (name == NULL || name[0] == '\0') {
        return refuse(refusal, "%s: instanceName refused: it is %s; must be a name", call,
                      name == NULL ? "a null pointer" : "empty");
    }
    if (token == NULL || strcmp(token, MODEL_GUID) != 0) {
        return refuse(refusal, "%s: %s = '%.80s' refused: must be '%s'; the model description is of another build",
                      call, FMI.token, token == NULL ? "(null)" : token, MODEL_GUID);
    }
    return true;
}

/* All log categories, or none. */
static void enable_all(bool categories[STATUSES], bool enabled) {
    for (int category = 0; category < STATUSES; category++) {
        categories[category] = enabled;
    }
}

Instance *instance_create(const Host *host, const char *call, const char *name, const char *token, bool debugging) {
    Refusal refusal;
    if (!instance_check(call, name, token, &refusal)) {
        return refuse_instance(host, name, &refusal);
    }
    size_t length = strlen(name);
    Instance *instance = host_allocate(host, sizeof *instance + length + 1);
    if (instance == NULL) {
        refuse(&refusal, "%s: no memory for an instance", call);
        return refuse_instance(host, name, &refusal);
    }
    memcpy(instance->name, name, length + 1);
    instance->host = *host;
    enable_all(instance->enabled, debugging);
    /* The log is the only place that says why a call failed. */
    instance->enabled[STATUS_ERROR] = instance->enabled[STATUS_FATAL] = true;
    component_begin(&instance->component, &(Memory){host_allocate, host_free, &instance->host});
    component_reset(&instance->component);
    return instance;
}

void instance_free(Instance *instance) {
    if (instance != NULL) {
        Host host = instance->host;
        component_end(&instance->component);
        host_free(&host, instance);
    }
}

static bool enable(bool categories[STATUSES], const char *call, const char *category, bool enabled, Refusal *refusal) {
    for (int known = 0; category != NULL && known < STATUSES; known++) {
        if (strcmp(category, CATEGORIES[known]) == 0) {
            categories[known] = enabled;
            return true;
        }
    }
    return refuse(refusal, "%s: category '%.80s' refused: must be one of %s, %s, %s, %s, %s", call,
                  category == NULL ? "(null)" : category, CATEGORIES[STATUS_WARNING], CATEGORIES[STATUS_DISCARD],
                  CATEGORIES[STATUS_ERROR], CATEGORIES[STATUS_FATAL], CATEGORIES[STATUS_OK]);
}

Status set_debug_logging(Instance *instance, const char *call, bool logging_on, size_t count,
                         const char *const *categories) {
    Refusal refusal;
    if (instance == NULL) {
        return STATUS_ERROR;
    }
    bool enabled[STATUSES];
    bool known = (count <= STATUSES && (count == 0 || categories != NULL)) ||
                 refuse(&refusal, "%s: nCategories = %lu refused: must be from 0 to %d, with as many categories", call,
                        (unsigned long)count, STATUSES);
    enable_all(enabled, logging_on && count == 0);
    for (size_t i = 0; known && i < count; i++) {
        known = enable(enabled, call, categories[i], logging_on, &refusal);
    }
    if (known) {
        memcpy(instance->enabled, enabled, sizeof enabled);
    }
    return answer(instance, known, &refusal);
}

Status instance_reset(Instance *instance) {
    if (instance == NULL) {
        return STATUS_ERROR;
    }
    component_reset(&instance->component);
    instance->last_step = STATUS_OK;
    return STATUS_OK;
}

Status lifecycle_call(Instance *instance, bool (*change)(Component *component, Refusal *refusal)) {
    Refusal refusal;
    bool done = instance != NULL && change(&instance->component, &refusal);
    return answer(instance, done, &refusal);
}

Status report(const Instance *instance, Status status, const char *text) {
    if (instance != NULL && (instance->enabled[status] || instance->enabled[STATUS_OK])) {
        send_message(&instance->host, instance->name, status, text);
    }
    return status;
}

Status answer(const Instance *instance, bool done, const Refusal *refusal) {
    return done ? STATUS_OK : report(instance, STATUS_ERROR, refusal->text);
}
