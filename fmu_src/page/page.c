/* The component in a web page: one instance, driven from JavaScript through two buffers.
 *
 * Each function that returns a bool leaves the component as it was where it returns false, and the reason in
 * `refusal_text`. */
#include <stdlib.h>

#include "component/component.h"

#define EXPORT(name) __attribute__((export_name(#name)))

static Component component;
static Refusal refusal;
static unsigned references[VARIABLE_COUNT];
static double values[VARIABLE_COUNT];

/* Value references to set or to read. */
EXPORT(references_buffer) unsigned *references_buffer(void) {
    return references;
}

/* Values to set, or the values read. */
EXPORT(values_buffer) double *values_buffer(void) {
    return values;
}

EXPORT(refusal_text) const char *refusal_text(void) {
    return refusal.text;
}

static void *allocate(const void *host, size_t size) {
    (void)host;
    return calloc(1, size);
}

static void release(const void *host, void *memory) {
    (void)host;
    free(memory);
}

/* Begin a run at time 0 with `count` values from the buffers, all others at their start. */
EXPORT(start) bool start(unsigned count) {
    const Experiment experiment = {.stop_time = INFINITY};
    component_begin(&component, &(Memory){allocate, release, NULL});
    component_reset(&component);
    return count <= VARIABLE_COUNT && component_setup_experiment(&component, &experiment, &refusal) &&
           component_enter_initialization(&component, &refusal) &&
           component_set(&component, references, values, count, &refusal) &&
           component_exit_initialization(&component, &refusal);
}

/* Set `count` inputs or tunable parameters from the buffers. */
EXPORT(set) bool set(unsigned count) {
    return component_set(&component, references, values, count, &refusal);
}

/* Read `count` variables into the buffer of values. */
EXPORT(get) bool get(unsigned count) {
    return component_get(&component, references, values, count, &refusal);
}

EXPORT(step) bool step(double time, double step_size) {
    return component_step(&component, time, step_size, &refusal);
}
