#include "state_access.h"

#include <string.h>

#include "../component/state_bytes.h"

/* Refuse a null pointer; the text names the argument. */
static bool pointer_check(const char *call, const char *argument, const void *pointer, Refusal *refusal) {
    return pointer != NULL ||
           refuse(refusal, "%s: %s refused: it is a null pointer; must point to memory", call, argument);
}

/* Copy `snapshot` to *state; allocate it where it is NULL. */
static bool copy_out(const Instance *instance, const Snapshot *snapshot, const char *call, void **state,
                     Refusal *refusal) {
    if (*state == NULL) {
        *state = host_allocate(&instance->host, sizeof *snapshot);
    }
    if (*state == NULL) {
        return refuse(refusal, "%s: no memory for a state", call);
    }
    memcpy(*state, snapshot, sizeof *snapshot);
    return true;
}

Status state_get(Instance *instance, const char *call, void **state) {
    Refusal refusal;
    bool done = instance != NULL && pointer_check(call, "the FMU state", state, &refusal) &&
                copy_out(instance, &instance->component.now, call, state, &refusal);
    return answer(instance, done, &refusal);
}

Status state_set(Instance *instance, const char *call, void *state) {
    Refusal refusal;
    bool done = instance != NULL && pointer_check(call, "the FMU state", state, &refusal) &&
                component_restore(&instance->component, state, &refusal);
    return answer(instance, done, &refusal);
}

Status state_free(const Instance *instance, void **state) {
    if (instance == NULL) {
        return STATUS_ERROR;
    }
    if (state != NULL && *state != NULL) {
        host_free(&instance->host, *state);
        *state = NULL;
    }
    return STATUS_OK;
}

Status state_size(const Instance *instance, const char *call, const void *state, size_t *size) {
    Refusal refusal;
    bool done = instance != NULL && pointer_check(call, "the FMU state", state, &refusal) &&
                pointer_check(call, "the size", size, &refusal);
    if (done) {
        *size = state_bytes_size();
    }
    return answer(instance, done, &refusal);
}

Status state_write(const Instance *instance, const char *call, const void *state, void *bytes, size_t size) {
    Refusal refusal;
    bool done = instance != NULL && pointer_check(call, "the FMU state", state, &refusal) &&
                pointer_check(call, "the serialised state", bytes, &refusal);
    if (done && size != state_bytes_size()) {
        done = refuse(&refusal, "%s: size = %lu refused: must be %lu", call, (unsigned long)size,
                      (unsigned long)state_bytes_size());
    }
    if (done) {
        state_bytes_write(state, bytes);
    }
    return answer(instance, done, &refusal);
}

Status state_read(const Instance *instance, const char *call, const void *bytes, size_t size, void **state) {
    Refusal refusal;
    Snapshot snapshot;
    bool done = instance != NULL && pointer_check(call, "the serialised state", bytes, &refusal) &&
                pointer_check(call, "the FMU state", state, &refusal) &&
                state_bytes_read(&snapshot, bytes, size, &refusal) &&
                copy_out(instance, &snapshot, call, state, &refusal);
    return answer(instance, done, &refusal);
}
