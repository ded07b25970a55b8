/* Memory of a host, for what is made when it is first needed. */
#pragma once

#include <stddef.h>

/* `allocate` gives `size` bytes, all zero, or NULL if out of memory; `release` takes them back, and ignores NULL.
 * `host` is the first argument of both. */
typedef struct {
    void *(*allocate)(const void *host, size_t size);
    void (*release)(const void *host, void *memory);
    const void *host;
} Memory;
