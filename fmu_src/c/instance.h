/* An FMI instance: a component, and the host's memory and logger. */
#ifndef SLIDER_INSTANCE_H
#define SLIDER_INSTANCE_H

#include <stdbool.h>
#include <stddef.h>

#include "component.h"
#include "fmi2Functions.h"
#include "refusal.h"

/* The header of fmpy leaves out the prefix of FMI 2.0 for static linking. */
#ifdef FMI2_FUNCTION_PREFIX
#undef fmi2FullName
#define fmi2Paste(a, b) a##b
#define fmi2PasteB(a, b) fmi2Paste(a, b)
#define fmi2FullName(name) fmi2PasteB(FMI2_FUNCTION_PREFIX, name)
#endif

/* The log categories, in the order of the model description. */
typedef enum {
    STATUS_WARNING,
    STATUS_DISCARD,
    STATUS_ERROR,
    STATUS_FATAL,
    ALL_MESSAGES,
    CATEGORY_COUNT
} Category;

/* `enabled` are the log categories that the host asked for. */
typedef struct {
    Component component;
    fmi2CallbackFunctions host;
    bool enabled[CATEGORY_COUNT];
    fmi2Status last_step;
    char name[]; /* ends with 0 */
} Instance;

/* Zeroed memory from the host's functions, or from calloc if it has none; NULL if out of memory. */
void *host_allocate(const fmi2CallbackFunctions *host, size_t size);
void host_free(const fmi2CallbackFunctions *host, void *memory);

/* Enable all log categories, or disable them. */
void enable_all_messages(Instance *instance, bool enabled);

/* Enable the log categories after instantiation: all while `debugging`, otherwise errors, as nothing
 * else says why a call failed. */
void enable_initial_messages(Instance *instance, bool debugging);

/* Enable one more log category. Refuse an unknown one. */
bool enable_messages(Instance *instance, const char *category, Refusal *refusal);

/* Send a text with its status and category to the host's logger, if there is one. */
void send_message(const fmi2CallbackFunctions *host, const char *instance_name, fmi2Status status,
                  const char *text);

/* Send a text if there is an instance and its category is enabled; return the status. */
fmi2Status report(const Instance *instance, fmi2Status status, const char *text);

/* Return fmi2OK for a call that is `done`; otherwise report the refusal and return fmi2Error. A call
 * without an instance is never done. */
fmi2Status answer(const Instance *instance, bool done, const Refusal *refusal);

#endif
