/* An FMI instance: a component, and the host's memory and logger. The same for every version of FMI. */
#pragma once

#include "../component/component.h"

/* The status of a call, with the numbers of FMI, whose versions have a type of their own for it each. */
enum { STATUS_OK, STATUS_WARNING, STATUS_DISCARD, STATUS_ERROR, STATUS_FATAL, STATUSES };
typedef unsigned Status;

/* Functions of the host. `allocate` and `release` are NULL if it offers no memory. `logger`, NULL for none, has the
 * type of the FMI version; `log` is the function of that version that calls it. */
typedef struct Host {
    void *environment;
    void *(*allocate)(size_t count, size_t size);
    void (*release)(void *memory);
    void (*logger)(void);
    void (*log)(const struct Host *host, const char *instance_name, Status status, const char *category,
                const char *text);
} Host;

/* `enabled` are the log categories that the host asked for: one for each status, and that of all messages in the place
 * of STATUS_OK. `event_mode_used` and `early_return_allowed` are FMI 3.0's, `last_step` is the status that FMI 2.0 asks
 * for. */
typedef struct {
    Component component;
    Host host;
    bool enabled[STATUSES];
    bool event_mode_used, early_return_allowed;
    Status last_step;
    char name[]; /* ends with 0 */
} Instance;

/* Zeroed memory from the functions of a Host, or from calloc if it has none; NULL if out of memory. */
void *host_allocate(const void *host, size_t size);

/* Give it back; NULL is ignored. */
void host_free(const void *host, void *memory);

/* Send the refusal of an instance to the host, even with logging off: the host has no other source for the reason.
 * Return NULL. */
void *refuse_instance(const Host *host, const char *name, const Refusal *refusal);

/* Make an instance for the function `call`, with start values. Refuse one without a name, and a `token` that is not
 * MODEL_GUID: send the reason and return NULL. */
Instance *instance_create(const Host *host, const char *call, const char *name, const char *token, bool debugging);

void instance_free(Instance *instance);

/* Give an instance its start values. */
Status instance_reset(Instance *instance);

/* Change the state of the life cycle by a function of the component. */
Status lifecycle_call(Instance *instance, bool (*change)(Component *component, Refusal *refusal));

/* Enable the log categories named, or all if none is; or disable all. */
Status set_debug_logging(Instance *instance, const char *call, bool logging_on, size_t count,
                         const char *const *categories);

/* Send a text if there is an instance and its category is enabled; return the status. */
Status report(const Instance *instance, Status status, const char *text);

/* Return STATUS_OK for a call that is `done`; otherwise report the refusal and return STATUS_ERROR. A call without an
 * instance is never done. */
Status answer(const Instance *instance, bool done, const Refusal *refusal);
