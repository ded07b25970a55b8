/* An FMI instance: a component, and the host's memory and logger. */
#ifndef SLIDER_INSTANCE_H
#define SLIDER_INSTANCE_H

#include <stdbool.h>
#include <stddef.h>

#include "component.h"
#include "fmi2/fmi2Functions.h"
#include "refusal.h"

/* The categories of messages, as the model description lists them. */
typedef enum {
    STATUS_WARNING,
    STATUS_DISCARD,
    STATUS_ERROR,
    STATUS_FATAL,
    ALL_MESSAGES,
    CATEGORY_COUNT
} Category;

/* `wanted` tells the categories that the host asked for. */
typedef struct {
    Component component;
    fmi2CallbackFunctions host;
    bool wanted[CATEGORY_COUNT];
    fmi2Status last_step;
    char name[]; /* ended by 0 */
} Instance;

/* Zeroed memory of the host, or of C where the host has none to give; NULL if there is no more. */
void *host_allocate(const fmi2CallbackFunctions *host, size_t size);
void host_free(const fmi2CallbackFunctions *host, void *memory);

/* Has all messages sent, or none. */
void want_all_messages(Instance *instance, bool wanted);

/* Has messages sent as a host wants them that has `debugging` on or not: errors in any case, as they
 * are all that tells why a call failed. */
void want_first_messages(Instance *instance, bool debugging);

/* Has messages of one more category sent. Refuses a category that is not known. */
bool want_messages(Instance *instance, const char *category, Refusal *refusal);

/* Sends a text to a host's logger, if it has one, with category and status. */
void send_message(const fmi2CallbackFunctions *host, const char *instance_name, fmi2Status status,
                  const char *text);

/* Sends a text if its category is wanted; returns the status. */
fmi2Status report(const Instance *instance, fmi2Status status, const char *text);

/* fmi2OK if the call was carried out, else fmi2Error with the refusal as message. */
fmi2Status answer(const Instance *instance, bool done, const Refusal *refusal);

/* The answer of a function that this FMU does not have: fmi2Error with the text as message. */
fmi2Status not_offered(fmi2Component component, const char *text);

#endif
