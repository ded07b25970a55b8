/* Calls all functions of an FMU in random order with good, bad and absurd arguments.
 *
 *     fuzz LIBRARY GUID SEED CALLS [SETTABLE]
 *
 * SETTABLE is the number of variables that can be set, that of the slider unless it is given.
 *
 * Fails (1) when a call that is not carried out goes unlogged, is logged with another status, changes
 * the state, or answers a status that no host should see there; when an output that is read with fmi2OK
 * is not finite; when a call exceeds two seconds; when memory is left behind. A crash or a hang speaks for itself. Ends with a line of what
 * was done. */
#include "fuzz_host.h"
#include "variables.h"

enum { INSTANCES = 4, STATES = 6, MAX_BYTES = 8192, SECONDS = 2 };

static FmuLibrary fmu;
static const char *guid;
static unsigned settable = SETTABLE_COUNT;
static fmi2Component instances[INSTANCES];
static fmi2FMUstate states[STATES];
static fmi2Byte stored[MAX_BYTES];
static size_t stored_size = 0;
static double longest_call = 0.0;
static unsigned long by_call[64], carried_out[64];

static fmi2ValueReference references[ROOM];
static fmi2Real reals[ROOM];
static fmi2Integer integers[ROOM];
static fmi2String strings[ROOM];

/* The Integers of the slider; the other references below `settable` are Reals that can be set. */
static int is_choice(unsigned reference) {
    return reference == VR_FRICTION_FACES || reference == VR_FRICTION_LAW || reference == VR_FIDELITY
           || reference == VR_AVERAGING_ORDER;
}

/* Half of the calls get arguments that may well be carried out. */
static void draw_arguments(int for_integers) {
    int i, plain = one_in(2) && (!for_integers || settable > VR_FRICTION_FACES);
    for (i = 0; i < ROOM; i++) {
        do references[i] = plain ? below(settable) : random_reference();
        while (plain && is_choice(references[i]) != for_integers);
        reals[i] = plain ? 2.0 * random_share() : random_real();
        integers[i] = plain ? (int)below(3) : random_integer();
        strings[i] = one_in(3) ? NULL : one_in(2) ? "logAll" : "no such category %s %n";
    }
}

static void *or_null(void *pointer) {
    return one_in(40) ? NULL : pointer;
}

static fmi2String some_name(void) {
    static const char *const names[] = {"slider", "", "a name with %s and %n in it"};
    return one_in(10) ? NULL : names[one_in(4) ? below(3) : 0];
}

static fmi2Component some_instance(void) {
    return instances[below(INSTANCES)];
}

/* The serialised state, to see whether a refused call has changed it; 0 bytes where there is none. */
static size_t state_of(fmi2Component instance, fmi2Byte bytes[MAX_BYTES]) {
    fmi2FMUstate state = NULL;
    size_t size = 0;
    int kept = memory_is_scarce;
    if (!instance) return 0;
    memory_is_scarce = 0;
    if (fmu.GetFMUstate(instance, &state) != fmi2OK
        || fmu.SerializedFMUstateSize(instance, state, &size) != fmi2OK || size > MAX_BYTES
        || fmu.SerializeFMUstate(instance, state, bytes, size) != fmi2OK
        || fmu.FreeFMUstate(instance, &state) != fmi2OK || state != NULL) {
        fail("the state could not be read");
    }
    memory_is_scarce = kept;
    return size;
}

static void instantiate(void) {
    unsigned slot = below(INSTANCES);
    fmi2Type type = one_in(10) ? (fmi2Type)random_integer() : fmi2CoSimulation;
    fmi2String given = one_in(10) ? some_name() : guid;
    const fmi2CallbackFunctions *callbacks = one_in(50) ? NULL : &CALLBACKS;
    fmi2Component made;
    if (instances[slot]) fmu.FreeInstance(instances[slot]);
    present_call = "fmi2Instantiate";
    said.messages = 0;
    made = fmu.Instantiate(some_name(), type, given, one_in(2) ? NULL : "file:///nowhere",
                           callbacks, fmi2False, one_in(20) ? fmi2False : fmi2True);
    if (!made && callbacks && !said.messages) fail("no instance, and no word why");
    instances[slot] = made;
    if (made) fmu.SetDebugLogging(made, fmi2True, 0, NULL);
}

static fmi2Status new_state(fmi2Component c) {
    return fmu.GetFMUstate(c, or_null(&states[below(STATES)]));
}

static fmi2Status write_state(fmi2Component c) {
    size_t size = 0;
    fmi2FMUstate state = states[below(STATES)];
    fmi2Status status = fmu.SerializedFMUstateSize(c, state, or_null(&size));
    if (status != fmi2OK || size == 0) return status;
    if (size > MAX_BYTES) fail("a state does not fit");
    stored_size = one_in(20) ? random_count() % MAX_BYTES : size;
    return fmu.SerializeFMUstate(c, state, or_null(stored), stored_size);
}

static fmi2Status read_state(fmi2Component c) {
    size_t flips = one_in(2) ? below(4) : 0, size = one_in(20) ? below(MAX_BYTES) : stored_size;
    while (flips-- > 0 && stored_size > 0) stored[below((uint32_t)stored_size)] ^= (char)(1 << below(8));
    return fmu.DeSerializeFMUstate(c, or_null(stored), size, or_null(&states[below(STATES)]));
}

static fmi2Status read_values(fmi2Component c) {
    size_t i, count = random_count();
    fmi2Real *values = or_null(reals);
    fmi2Status status;
    if (one_in(2))
        for (i = 0; i < ROOM; i++) references[i] = random_reference();
    status = fmu.GetReal(c, or_null(references), count, values);
    for (i = 0; status == fmi2OK && values && i < count; i++)
        if (!isfinite(values[i])) fail("an output that is not finite");
    return status;
}

static fmi2Status do_step(fmi2Component c) {
    fmi2Real now = 0.0;
    fmu.GetRealStatus(c, fmi2LastSuccessfulTime, &now);
    if (one_in(20)) now = random_real();
    return fmu.DoStep(c, now, random_step(), below(2));
}

static fmi2Status set_logging(fmi2Component c) {
    fmi2Status status = fmu.SetDebugLogging(c, below(2), random_count() % 8, or_null(strings));
    fmi2Status back = fmu.SetDebugLogging(c, fmi2True, 0, NULL);
    if (c && back != fmi2OK) fail("logging cannot be switched on");
    /* With logging off there may be no message, and that is as it should be. */
    return status == fmi2Error && !said.messages ? fmi2OK : status;
}

enum { INPUTS = 3 };

/* Orders of derivatives, most often the one there is, and half of the time references of inputs. */
static fmi2Integer *orders(void) {
    int i, of_inputs = one_in(2);
    for (i = 0; i < ROOM; i++) {
        integers[i] = one_in(40) ? random_integer() : 1;
        if (of_inputs) references[i] = below(INPUTS);
    }
    return or_null(integers);
}

#define REFS or_null(references), random_count()
#define STATUS_KIND (fmi2StatusKind)(one_in(8) ? random_integer() : (int)below(4))

/* Name, weight, call: `c` is an instance or a null pointer. */
#define FUNCTIONS(X) \
    X(fmi2SetDebugLogging, 2, set_logging(c)) \
    X(fmi2SetupExperiment, 6, fmu.SetupExperiment(c, one_in(4), random_real(), one_in(3) ? random_real() : 0.0, one_in(8), random_real())) \
    X(fmi2EnterInitializationMode, 8, fmu.EnterInitializationMode(c)) \
    X(fmi2ExitInitializationMode, 10, fmu.ExitInitializationMode(c)) \
    X(fmi2Terminate, 1, fmu.Terminate(c)) \
    X(fmi2Reset, 2, fmu.Reset(c)) \
    X(fmi2GetReal, 12, read_values(c)) \
    X(fmi2GetInteger, 3, fmu.GetInteger(c, REFS, or_null(integers))) \
    X(fmi2GetBoolean, 2, fmu.GetBoolean(c, REFS, or_null(integers))) \
    X(fmi2GetString, 2, fmu.GetString(c, REFS, or_null(strings))) \
    X(fmi2SetReal, 16, fmu.SetReal(c, REFS, or_null(reals))) \
    X(fmi2SetInteger, 6, fmu.SetInteger(c, REFS, or_null(integers))) \
    X(fmi2SetBoolean, 2, fmu.SetBoolean(c, REFS, or_null(integers))) \
    X(fmi2SetString, 2, fmu.SetString(c, REFS, or_null(strings))) \
    X(fmi2GetFMUstate, 6, new_state(c)) \
    X(fmi2SetFMUstate, 6, fmu.SetFMUstate(c, states[below(STATES)])) \
    X(fmi2FreeFMUstate, 2, fmu.FreeFMUstate(c, or_null(&states[below(STATES)]))) \
    X(fmi2SerializeFMUstate, 6, write_state(c)) \
    X(fmi2DeSerializeFMUstate, 6, read_state(c)) \
    X(fmi2GetDirectionalDerivative, 1, fmu.GetDirectionalDerivative(c, REFS, REFS, or_null(reals), or_null(reals))) \
    X(fmi2SetRealInputDerivatives, 8, fmu.SetRealInputDerivatives(c, REFS, orders(), or_null(reals))) \
    X(fmi2GetRealOutputDerivatives, 3, fmu.GetRealOutputDerivatives(c, REFS, orders(), or_null(reals))) \
    X(fmi2DoStep, 24, do_step(c)) \
    X(fmi2CancelStep, 1, fmu.CancelStep(c)) \
    X(fmi2GetStatus, 1, fmu.GetStatus(c, STATUS_KIND, or_null(integers))) \
    X(fmi2GetRealStatus, 1, fmu.GetRealStatus(c, STATUS_KIND, or_null(reals))) \
    X(fmi2GetIntegerStatus, 1, fmu.GetIntegerStatus(c, STATUS_KIND, or_null(integers))) \
    X(fmi2GetBooleanStatus, 1, fmu.GetBooleanStatus(c, STATUS_KIND, or_null(integers))) \
    X(fmi2GetStringStatus, 1, fmu.GetStringStatus(c, STATUS_KIND, or_null(strings))) \
    X(fmi2EnterEventMode, 1, fmu.EnterEventMode(c)) \
    X(fmi2NewDiscreteStates, 1, fmu.NewDiscreteStates(c, NULL)) \
    X(fmi2EnterContinuousTimeMode, 1, fmu.EnterContinuousTimeMode(c)) \
    X(fmi2CompletedIntegratorStep, 1, fmu.CompletedIntegratorStep(c, fmi2True, or_null(integers), or_null(integers))) \
    X(fmi2SetTime, 1, fmu.SetTime(c, random_real())) \
    X(fmi2SetContinuousStates, 1, fmu.SetContinuousStates(c, or_null(reals), random_count())) \
    X(fmi2GetDerivatives, 1, fmu.GetDerivatives(c, or_null(reals), random_count())) \
    X(fmi2GetEventIndicators, 1, fmu.GetEventIndicators(c, or_null(reals), random_count())) \
    X(fmi2GetContinuousStates, 1, fmu.GetContinuousStates(c, or_null(reals), random_count())) \
    X(fmi2GetNominalsOfContinuousStates, 1, fmu.GetNominalsOfContinuousStates(c, or_null(reals), random_count()))

#define ROW(name, weight, call) {#name, weight},
static const Function FUNCTION[] = {FUNCTIONS(ROW)};
#undef ROW

enum { FUNCTION_COUNT = sizeof FUNCTION / sizeof *FUNCTION };

static fmi2Status call(unsigned function, fmi2Component c) {
    unsigned index = 0;
#define CASE(name, weight, call) if (function == index++) return call;
    FUNCTIONS(CASE)
#undef CASE
    return fmi2Fatal;
}

static int may_discard(const char *name) {
    return strncmp(name, "fmi2Get", 7) == 0 && strstr(name, "Status") != NULL;
}

static void one_call(void) {
    static fmi2Byte before[MAX_BYTES], after[MAX_BYTES];
    unsigned function = some_function(FUNCTION, FUNCTION_COUNT);
    fmi2Component instance = one_in(100) ? NULL : some_instance();
    size_t size = one_in(4) ? state_of(instance, before) : 0;
    fmi2Status status;
    clock_t began;
    double seconds;
    present_call = FUNCTION[function].name;
    draw_arguments(strstr(present_call, "Integer") != NULL);
    by_call[function]++;
    said.messages = 0;
    said.text[0] = '\0';
    began = clock();
    status = call(function, instance);
    seconds = (double)(clock() - began) / CLOCKS_PER_SEC;
    if (seconds > longest_call) longest_call = seconds;
    if (seconds > SECONDS) fail("a call took more than two seconds");
    if (status == fmi2OK) {
        carried_out[function]++;
        return;
    }
    refusals++;
    if (status != fmi2Error && !(status == fmi2Discard && may_discard(present_call)))
        fail("a status that is neither fmi2OK nor fmi2Error");
    if (instance && (!said.messages || said.status != status)) fail("refused, but not logged so");
    if (size && (state_of(instance, after) != size || memcmp(before, after, size)))
        fail("refused, but the state has changed");
}

static void put_in_order(void) {
    int i;
    memory_is_scarce = 0;
    for (i = 0; i < STATES; i++)
        if (states[i]) fmu.FreeFMUstate(instances[0], &states[i]);
    for (i = 0; i < INSTANCES; i++)
        if (instances[i]) fmu.FreeInstance(instances[i]);
    present_call = "after all calls";
    if (blocks_in_use) fail("memory is left behind");
}

int main(int count, char **arguments) {
    unsigned long requested;
    unsigned i;
    if ((count != 5 && count != 6) || !load_fmu_library(&fmu, arguments[1])) return COULD_NOT_RUN;
    guid = arguments[2];
    random_state = 2 * strtoull(arguments[3], NULL, 10) + 1;
    requested = strtoul(arguments[4], NULL, 10);
    if (count == 6) settable = (unsigned)strtoul(arguments[5], NULL, 10);
    for (calls = 0; calls < requested; calls++) {
        memory_is_scarce = one_in(20);
        if (one_in(500) || !instances[0]) instantiate();
        else one_call();
    }
    while (!instances[0]) instantiate();
    put_in_order();
    printf("%lu calls, %lu refused, longest %.3g s\n", calls, refusals, longest_call);
    for (i = 0; i < FUNCTION_COUNT; i++) printf("%s %lu %lu\n", FUNCTION[i].name, by_call[i], carried_out[i]);
    return 0;
}
