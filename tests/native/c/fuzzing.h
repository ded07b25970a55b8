/* What the fuzzers of both versions of FMI share: instances, states, arguments, and what is judged of a call.
 *
 * A fuzzer first names its types Instance, State, Byte, Status, Reference, Integer and String, and the reference
 * FIRST of its first variable, and says whether its host's MEMORY_MAY_RUN_OUT; its `fmu` has the calls for states
 * by their names of FMI 2.0, and GET_REALS reads variables. */
#ifndef NATIVE_FUZZING_H
#define NATIVE_FUZZING_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "random_values.h"
#include "variables.h"

static const int OK = 0, DISCARD = 2, ERROR = 3;
enum { FAILED = 1, COULD_NOT_RUN = 2 };
enum { INSTANCES = 4, STATES = 6, MAX_BYTES = 8192, MAX_FUNCTIONS = 128, LONGEST_MESSAGE = 4096 };

static Instance instances[INSTANCES];
static State states[STATES];
static Byte stored[MAX_BYTES];
static size_t stored_size = 0;
static unsigned settable = SETTABLE_COUNT;
static int memory_is_scarce = 0;
static double seconds = 2.0, longest_call = 0.0;
static const char *present_call = "none";
static unsigned messages = 0;
static unsigned long calls = 0, refusals = 0, by_call[MAX_FUNCTIONS], carried_out[MAX_FUNCTIONS];

static Reference references[ROOM];
static double reals[ROOM];
static Integer integers[ROOM];
static String strings[ROOM];

/* The last log message of the present call. */
static struct {
    Status status;
    char text[LONGEST_MESSAGE];
} said;

/* What a fuzzer defines: how it makes a new instance in a place, and calls a function with arguments. */
static void instantiate(unsigned slot);
static Status call(unsigned function, Instance c);

static void fail(const char *what) {
    printf("call %lu, %s: %s (last said: %s)\n", calls, present_call, what, said.text);
    fflush(stdout);
    exit(FAILED);
}

/* The Integers of the slider; its other variables below `settable` are Reals that can be set. */
static int is_choice(unsigned reference) {
    unsigned variable = reference - FIRST;
    return variable == VR_FRICTION_FACES || variable == VR_FRICTION_LAW || variable == VR_FIDELITY
           || variable == VR_AVERAGING_ORDER;
}

static void *or_null(void *pointer) {
    return one_in(40) ? NULL : pointer;
}

/* Half of the calls get arguments that may well be carried out. */
static void draw_arguments(int for_integers) {
    int i, plain = one_in(2) && (!for_integers || settable > VR_FRICTION_FACES);
    for (i = 0; i < ROOM; i++) {
        do references[i] = FIRST + (plain ? below(settable) : random_reference());
        while (plain && is_choice(references[i]) != for_integers);
        if (!plain && FIRST && one_in(2)) references[i] -= FIRST;
        reals[i] = plain ? 2.0 * random_share() : random_real();
        integers[i] = plain ? (int)below(3) : random_integer();
        strings[i] = one_in(3) ? NULL : one_in(2) ? "logAll" : "no such category %s %n";
    }
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

static Status read_values(Instance c) {
    size_t i, count = random_count();
    double *values = or_null(reals);
    Status status;
    if (one_in(2))
        for (i = 0; i < ROOM; i++) references[i] = (FIRST > 0) + random_reference();
    status = GET_REALS(c, or_null(references), count, values);
    for (i = 0; status == OK && values && i < count; i++)
        if (!isfinite(values[i])) fail("an output that is not finite");
    return status;
}

static Status set_logging(Instance c) {
    Status status = fmu.SetDebugLogging(c, below(2), random_count() % 8, or_null(strings));
    Status back = fmu.SetDebugLogging(c, 1, 0, NULL);
    if (c && back != OK) fail("logging cannot be switched on");
    /* With logging off there may be no message, and that is as it should be. */
    return status == ERROR && !messages ? OK : status;
}

/* Only functions such as fmi2GetStatus may discard. */
static void judge_refusal(Status status, Instance instance) {
    int may_discard = !strncmp(present_call, "fmi2Get", 7) && strstr(present_call, "Status");
    if (status != ERROR && !(status == DISCARD && may_discard)) fail("a status that is neither OK nor error");
    if (instance && (!messages || said.status != status)) fail("refused, but not logged so");
}

/* `of_integers` is in the names of the functions whose arguments are Integers. */
static void one_call(const Function *functions, unsigned count, const char *of_integers) {
    static Byte before[MAX_BYTES], after[MAX_BYTES];
    unsigned function = some_function(functions, count);
    Instance instance = one_in(100) ? NULL : instances[below(INSTANCES)];
    size_t size = one_in(4) ? state_of(instance, before) : 0;
    Status status;
    clock_t began;
    double taken;
    present_call = functions[function].name;
    draw_arguments(strstr(present_call, of_integers) != NULL);
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
static void fuzz(unsigned long requested, const Function *functions, unsigned count,
                 const char *of_integers) {
    unsigned i;
    for (calls = 0; calls < requested; calls++) {
        memory_is_scarce = MEMORY_MAY_RUN_OUT && one_in(20);
        if (one_in(500) || !instances[0]) instantiate(below(INSTANCES));
        else one_call(functions, count, of_integers);
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
