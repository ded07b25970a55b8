/* The host of the fuzzer: memory that may run out, a logger that checks its arguments. */
#ifndef NATIVE_FUZZ_HOST_H
#define NATIVE_FUZZ_HOST_H

#include <stdarg.h>
#include <stdlib.h>
#include <time.h>

#include "fmu_library.h"
#include "random_values.h"

enum { LONGEST_MESSAGE = 4096, FAILED = 1, COULD_NOT_RUN = 2 };

/* Log messages of the present call: their number, status and text of the last one. */
static struct {
    unsigned messages;
    fmi2Status status;
    char text[LONGEST_MESSAGE];
} said;

static long blocks_in_use = 0;
static int memory_is_scarce = 0;
static const char *present_call = "none";
static unsigned long calls = 0, refusals = 0;

static void fail(const char *what) {
    printf("call %lu, %s: %s (said: %s)\n", calls, present_call, what, said.text);
    fflush(stdout);
    exit(FAILED);
}

static void *allocate(size_t count, size_t size) {
    void *block = memory_is_scarce && one_in(4) ? NULL : malloc(count * size);
    if (block) {
        memset(block, 0, count * size);
        blocks_in_use++;
    }
    return block;
}

static void release(void *block) {
    if (block) blocks_in_use--;
    free(block);
}

static void log_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                        fmi2String category, fmi2String format, ...) {
    va_list arguments;
    int length;
    if (environment != &said) fail("the logger was called with another environment");
    if (!instance || !category || !format) fail("the logger was called with a null pointer");
    va_start(arguments, format);
    length = vsnprintf(said.text, sizeof said.text, format, arguments);
    va_end(arguments);
    if (length <= 0 || length >= LONGEST_MESSAGE) fail("a message is empty, or longer than a page");
    said.messages++;
    said.status = status;
}

static const fmi2CallbackFunctions CALLBACKS = {log_message, allocate, release, NULL, &said};

#endif
