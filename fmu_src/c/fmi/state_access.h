/* The state of an instance as FMI hands it out, whatever its version: a Snapshot behind a pointer. `call` is the name
 * of the FMI function, for refusals. */
#pragma once

#include "instance.h"

/* Copy the state of the instance to *state, which is allocated where it is NULL. */
Status state_get(Instance *instance, const char *call, void **state);

Status state_set(Instance *instance, const char *call, void *state);
Status state_free(const Instance *instance, void **state);

/* The number of bytes of a serialised state. */
Status state_size(const Instance *instance, const char *call, const void *state, size_t *size);

Status state_write(const Instance *instance, const char *call, const void *state, void *bytes, size_t size);

/* Read what state_write wrote into *state, which is allocated where it is NULL. */
Status state_read(const Instance *instance, const char *call, const void *bytes, size_t size, void **state);
