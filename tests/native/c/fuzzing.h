/* What the fuzzers of both versions of FMI share: instances, states, and what is judged of a call.
 *
 * A fuzzer first names its types Instance, State, Byte and Status, of which 0 is OK, and the reference FIRST
 * of its first variable, and says whether its host's MEMORY_MAY_RUN_OUT; its `fmu` has the calls for states by
 * their names of FMI 2.0. */
#ifndef NATIVE_FUZZING_H
#define NATIVE_FUZZING_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "random_values.h"
#include "variables.h"

static const int OK = 0;
enum { FAILED = 1, COULD_NOT_RUN = 2 };
enum { INSTANCES = 4, STATES = 6, MAX_BYTES = 8192, MAX_FUNCTIONS = 128 };

static Instance instances[INSTANCES], present_instance = NULL;
static State states[STATES];
static Byte stored[MAX_BYTES];
static size_t stored_size = 0;
static unsigned settable = SETTABLE_COUNT;
static int memory_is_scarce = 0;
static double seconds = 2.0, longest_call = 0.0;
static const char *present_call = "none";
static unsigned messages = 0;
static unsigned long calls = 0, refusals = 0, by_call[MAX_FUNCTIONS], carried_out[MAX_FUNCTIONS];

/* What a fuzzer defines: how it ends, how it makes a new instance in a place, how it draws arguments and
 * calls a function with them, and what it demands of a call that is not carried out. */
static void fail(const char *what);
static void instantiate(unsigned slot);
static void draw_arguments(int for_integers);
static Status call(unsigned function, Instance c);
static void judge_refusal(Status status, Instance c);

/* The Integers of the slider; its other variables below `settable` are Reals that can be set. */
static int is_choice(unsigned reference) {
    unsigned variable = reference - FIRST;
    return variable == VR_FRICTION_FACES || variable == VR_FRICTION_LAW || variable == VR_FIDELITY
           || variable == VR_AVERAGING_ORDER;
}

static void *or_null(void *pointer) {
    return one_in(40) ? NULL : pointer;
}

/* The serialised state, to see whether a refused call has changed it; 0 bytes where there is none. */
static size_t state_of(Instance instance, Byte bytes[MAX_BYTES]) {
    State state = NULL;
    size_t size = 0;
    int kept = memory_is_scarce;
    if (!instance) return 0;
    memory_is_scarce = 0;
    if (fmu.GetFMUstate(instance, &state) != OK
        || fmu.SerializedFMUstateSize(instance, state, &size) != OK || size > MAX_BYTES
        || fmu.SerializeFMUstate(instance, state, bytes, size) != OK
        || fmu.FreeFMUstate(instance, &state) != OK || state != NULL) {
        fail("the state could not be read");
    }
    memory_is_scarce = kept;
    return size;
}

static Status write_state(Instance c) {
    size_t size = 0;
    State state = states[below(STATES)];
    Status status = fmu.SerializedFMUstateSize(c, state, or_null(&size));
    if (status != OK || size == 0) return status;
    if (size > MAX_BYTES) fail("a state does not fit");
    stored_size = one_in(20) ? random_count() % MAX_BYTES : size;
    return fmu.SerializeFMUstate(c, state, or_null(stored), stored_size);
}

static Status read_state(Instance c) {
    size_t flips = one_in(2) ? below(4) : 0, size = one_in(20) ? below(MAX_BYTES) : stored_size;
    while (flips-- > 0 && stored_size > 0) stored[below((uint32_t)stored_size)] ^= (Byte)(1 << below(8));
    return fmu.DeSerializeFMUstate(c, or_null(stored), size, or_null(&states[below(STATES)]));
}

/* `integers` is in the names of the functions whose arguments are Integers. */
static void one_call(const Function *functions, unsigned count, const char *integers) {
    static Byte before[MAX_BYTES], after[MAX_BYTES];
    unsigned function = some_function(functions, count);
    Instance instance = one_in(100) ? NULL : instances[below(INSTANCES)];
    size_t size = one_in(4) ? state_of(instance, before) : 0;
    Status status;
    clock_t began;
    double taken;
    present_call = functions[function].name;
    present_instance = instance;
    draw_arguments(strstr(present_call, integers) != NULL);
    by_call[function]++;
    messages = 0;
    began = clock();
    status = call(function, instance);
    taken = (double)(clock() - began) / CLOCKS_PER_SEC;
    if (taken > longest_call) longest_call = taken;
    if (taken > seconds) fail("a call took too long");
    if (status == OK) {
        carried_out[function]++;
        return;
    }
    refusals++;
    judge_refusal(status, instance);
    if (size && (state_of(instance, after) != size || memcmp(before, after, size)))
        fail("refused, but the state has changed");
}

/* Makes as many calls as `requested`; then frees all, and prints what was done. */
static void fuzz(unsigned long requested, const Function *functions, unsigned count, const char *integers) {
    unsigned i;
    for (calls = 0; calls < requested; calls++) {
        memory_is_scarce = MEMORY_MAY_RUN_OUT && one_in(20);
        if (one_in(500) || !instances[0]) instantiate(below(INSTANCES));
        else one_call(functions, count, integers);
    }
    while (!instances[0]) instantiate(below(INSTANCES));
    memory_is_scarce = 0;
    for (i = 0; i < STATES; i++)
        if (states[i]) fmu.FreeFMUstate(instances[0], &states[i]);
    for (i = 0; i < INSTANCES; i++)
        if (instances[i]) fmu.FreeInstance(instances[i]);
    printf("%lu calls, %lu refused, longest %.3g s\n", calls, refusals, longest_call);
    for (i = 0; i < count; i++) printf("%s %lu %lu\n", functions[i].name, by_call[i], carried_out[i]);
}

#endif
