/* FMI 2.0: get, set and serialise the complete state. An fmi2FMUstate is a Snapshot. */
#include <string.h>

#include "instance.h"
#include "snapshot.h"

/* Refuse a null pointer; the text names the argument. */
static bool pointer_check(const char *call, const char *argument, const void *pointer,
                          Refusal *refusal) {
    return pointer != NULL
           || refuse(refusal, "%s: %s refused: it is a null pointer; must point to %s", call,
                     argument, strcmp(argument, "FMUstate") == 0 ? "a state" : "memory");
}

/* Copy `snapshot` to *FMUstate; allocate it where it is NULL. */
static bool copy_out(const Instance *instance, const Snapshot *snapshot, const char *call,
                     fmi2FMUstate *FMUstate, Refusal *refusal) {
    if (*FMUstate == NULL) {
        *FMUstate = host_allocate(&instance->host, sizeof *snapshot);
    }
    if (*FMUstate == NULL) {
        return refuse(refusal, "%s: no memory for a state", call);
    }
    memcpy(*FMUstate, snapshot, sizeof *snapshot);
    return true;
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    Instance *instance = c;
    Refusal refusal;
    bool done = instance != NULL
                && pointer_check("fmi2GetFMUstate", "FMUstate", FMUstate, &refusal)
                && copy_out(instance, &instance->component.now, "fmi2GetFMUstate", FMUstate,
                            &refusal);
    return answer(instance, done, &refusal);
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
    Instance *instance = c;
    Refusal refusal;
    bool done = instance != NULL
                && pointer_check("fmi2SetFMUstate", "FMUstate", FMUstate, &refusal)
                && component_restore(&instance->component, FMUstate, &refusal);
    return answer(instance, done, &refusal);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    const Instance *instance = c;
    if (instance == NULL) {
        return fmi2Error;
    }
    if (FMUstate != NULL && *FMUstate != NULL) {
        host_free(&instance->host, *FMUstate);
        *FMUstate = NULL;
    }
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size) {
    const Instance *instance = c;
    Refusal refusal;
    bool done = instance != NULL
                && pointer_check("fmi2SerializedFMUstateSize", "FMUstate", FMUstate, &refusal)
                && pointer_check("fmi2SerializedFMUstateSize", "size", size, &refusal);
    if (done) {
        *size = snapshot_size();
    }
    return answer(instance, done, &refusal);
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate,
                                 fmi2Byte serializedState[], size_t size) {
    const Instance *instance = c;
    Refusal refusal;
    bool done = instance != NULL
                && pointer_check("fmi2SerializeFMUstate", "FMUstate", FMUstate, &refusal)
                && pointer_check("fmi2SerializeFMUstate", "serializedState", serializedState,
                                 &refusal);
    if (done && size != snapshot_size()) {
        done = refuse(&refusal, "fmi2SerializeFMUstate: size = %lu refused: must be %lu",
                      (unsigned long)size, (unsigned long)snapshot_size());
    }
    if (done) {
        snapshot_write(FMUstate, (unsigned char *)serializedState);
    }
    return answer(instance, done, &refusal);
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate) {
    const Instance *instance = c;
    Refusal refusal;
    Snapshot snapshot;
    bool done = instance != NULL
                && pointer_check("fmi2DeSerializeFMUstate", "serializedState", serializedState,
                              &refusal)
                && pointer_check("fmi2DeSerializeFMUstate", "FMUstate", FMUstate, &refusal)
                && snapshot_read(&snapshot, (const unsigned char *)serializedState, size, &refusal)
                && copy_out(instance, &snapshot, "fmi2DeSerializeFMUstate", FMUstate, &refusal);
    return answer(instance, done, &refusal);
}
