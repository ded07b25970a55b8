/* Calls all functions of an FMU of FMI 3.0 in random order with good, bad and absurd arguments.
 *
 *     fuzz3 LIBRARY TOKEN SEED CALLS SETTABLE SECONDS
 *
 * The references from 2 on are those of the variables, of which SETTABLE can be set; 1 is the time.
 *
 * Fails (1) when a call that is not carried out goes unlogged, changes the state, or answers anything
 * but fmi3Error; when an output that is read with fmi3OK is not finite; when a call takes more than
 * SECONDS of processor time. A crash or a hang speaks for itself. Ends with a line of what was done,
 * and for each function how often it was called and carried out. */
#include <dlfcn.h>
#include <string.h>

#include "fmi3FunctionTypes.h"

typedef fmi3Instance Instance;
typedef fmi3FMUState State;
typedef fmi3Byte Byte;
typedef fmi3Status Status;
enum { FIRST = 2, MEMORY_MAY_RUN_OUT = 0 };

/* Functions of the library. */
#define NAMES(X) \
    X(InstantiateCoSimulation) X(InstantiateModelExchange) X(InstantiateScheduledExecution) \
    X(FreeInstance) X(SetDebugLogging) X(EnterInitializationMode) X(ExitInitializationMode) \
    X(EnterEventMode) X(Terminate) X(Reset) X(GetFloat32) X(GetFloat64) X(GetInt8) X(GetUInt8) \
    X(GetInt16) X(GetUInt16) X(GetInt32) X(GetUInt32) X(GetInt64) X(GetUInt64) X(GetBoolean) \
    X(GetString) X(GetBinary) X(GetClock) X(SetFloat32) X(SetFloat64) X(SetInt8) X(SetUInt8) \
    X(SetInt16) X(SetUInt16) X(SetInt32) X(SetUInt32) X(SetInt64) X(SetUInt64) X(SetBoolean) \
    X(SetString) X(SetBinary) X(SetClock) X(GetNumberOfVariableDependencies) X(GetFMUState) \
    X(SetFMUState) X(FreeFMUState) X(SerializedFMUStateSize) X(SerializeFMUState) \
    X(DeserializeFMUState) X(GetDirectionalDerivative) X(GetAdjointDerivative) \
    X(EnterConfigurationMode) X(ExitConfigurationMode) X(EvaluateDiscreteStates) \
    X(UpdateDiscreteStates) X(EnterContinuousTimeMode) X(SetTime) X(SetContinuousStates) \
    X(GetContinuousStates) X(GetEventIndicators) X(GetNumberOfEventIndicators) \
    X(GetNumberOfContinuousStates) X(EnterStepMode) X(GetOutputDerivatives) X(DoStep) \
    X(GetIntervalDecimal) X(SetIntervalDecimal) X(ActivateModelPartition)

static struct {
#define MEMBER(name) fmi3##name##TYPE *name;
    NAMES(MEMBER)
#undef MEMBER
} fmu;

#define GetFMUstate GetFMUState
#define FreeFMUstate FreeFMUState
#define SerializedFMUstateSize SerializedFMUStateSize
#define SerializeFMUstate SerializeFMUState
#define DeSerializeFMUstate DeserializeFMUState
#include "fuzzing.h"

static const char *token;

static int load(const char *path) {
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL), *found;
    if (!handle) return 0;
#define FIND(name) \
    found = dlsym(handle, "fmi3" #name); \
    if (!found) return 0; \
    memcpy(&fmu.name, &found, sizeof found);
    NAMES(FIND)
#undef FIND
    return 1;
}

static fmi3ValueReference references[ROOM];
static double numbers[ROOM];
static fmi3Int32 integers[ROOM];
static fmi3String strings[ROOM];
static fmi3Binary binaries[ROOM];
static size_t sizes[ROOM];
static bool flags[ROOM];

/* The values that can be set, for who looks for the reason. */
static void show(fmi3Instance instance) {
    fmi3ValueReference reference;
    for (reference = FIRST; reference < FIRST + settable; reference++) {
        double number = 0.0;
        fmi3Int32 integer = 0;
        if (is_choice(reference)) {
            fmu.GetInt32(instance, &reference, 1, &integer, 1);
            number = integer;
        } else {
            fmu.GetFloat64(instance, &reference, 1, &number, 1);
        }
        printf("%u %.17g\n", reference, number);
    }
}

static void fail(const char *what) {
    fmi3Instance instance = present_instance;
    printf("call %lu, %s: %s\n", calls, present_call, what);
    fflush(stdout);
    present_instance = NULL; /* a failure while it is shown */
    if (instance) show(instance);
    exit(FAILED);
}

static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                        fmi3String message) {
    if (environment != &messages) fail("the logger was called with another environment");
    if (!category || !message || !*message) fail("the logger was called without a message");
    if (status != fmi3Error) fail("logged with a status that is not fmi3Error");
    messages++;
}

/* Half of the calls get arguments that may well be carried out. */
static void draw_arguments(int for_integers) {
    int i, plain = one_in(2);
    for (i = 0; i < ROOM; i++) {
        do references[i] = plain ? FIRST + below(settable) : random_reference() + one_in(2) * FIRST;
        while (plain && is_choice(references[i]) != for_integers);
        numbers[i] = plain ? 2.0 * random_share() : random_real();
        integers[i] = plain ? (int)below(3) : random_integer();
        strings[i] = one_in(3) ? NULL : one_in(2) ? "logAll" : "no such category %s %n";
        binaries[i] = one_in(2) ? NULL : stored;
        sizes[i] = random_count();
        flags[i] = one_in(2);
    }
}

static void instantiate(unsigned slot) {
    fmi3String name = one_in(10) ? NULL : "slider %s %n", given = one_in(10) ? NULL : token;
    size_t intermediate = one_in(20) ? random_count() : 0;
    fmi3Instance made;
    if (instances[slot]) fmu.FreeInstance(instances[slot]);
    present_call = "fmi3InstantiateCoSimulation";
    messages = 0;
    made = fmu.InstantiateCoSimulation(name, given, one_in(2) ? NULL : "nowhere", one_in(2), true,
                                       !one_in(3), !one_in(3), NULL, intermediate, &messages,
                                       log_message, NULL);
    if (!made && !messages) fail("no instance, and no word why");
    if (made && fmu.SetDebugLogging(made, true, 0, NULL) != fmi3OK) fail("logging is refused");
    instances[slot] = made;
    if (fmu.InstantiateModelExchange(name, token, NULL, false, true, &messages, log_message)
        || fmu.InstantiateScheduledExecution(name, token, NULL, false, true, &messages, log_message,
                                             NULL, NULL, NULL)) {
        fail("an instance of a kind that is not offered");
    }
}

static fmi3Status read_values(fmi3Instance c) {
    size_t i, count = random_count(), room = one_in(10) ? random_count() : count;
    double *values = or_null(numbers);
    fmi3Status status;
    if (one_in(2))
        for (i = 0; i < ROOM; i++) references[i] = 1 + below(VARIABLE_COUNT + 1);
    status = fmu.GetFloat64(c, or_null(references), count, values, room);
    for (i = 0; status == fmi3OK && values && i < count; i++)
        if (!isfinite(values[i])) fail("an output that is not finite");
    return status;
}

static fmi3Status step(fmi3Instance c) {
    bool event = false, ends = true, early = false;
    double last = 0.0, now = 0.0;
    const fmi3ValueReference time_reference = 1;
    fmi3Status status;
    fmu.GetFloat64(c, &time_reference, 1, &now, 1);
    if (one_in(20)) now = random_real();
    status = fmu.DoStep(c, now, random_step(), one_in(2), or_null(&event), or_null(&ends),
                        or_null(&early), or_null(&last));
    if (status == fmi3OK && (!isfinite(last) || ends)) fail("a step that ends nowhere");
    return status;
}

/* With logging off there may be no message, and that is as it should be. */
static fmi3Status set_logging(fmi3Instance c) {
    fmi3Status status = fmu.SetDebugLogging(c, one_in(2), random_count() % 8, or_null(strings));
    fmi3Status back = fmu.SetDebugLogging(c, true, 0, NULL);
    if (c && back != fmi3OK) fail("logging cannot be switched on");
    return status == fmi3Error && !messages ? fmi3OK : status;
}

#define REFS or_null(references), count
#define OTHER(c, name, type) \
    one_in(2) ? fmu.Get##name(c, REFS, (type *)or_null(numbers), room) \
              : fmu.Set##name(c, REFS, (const type *)or_null(numbers), room)

/* Name, weight, call: `c` is an instance or a null pointer. */
#define FUNCTIONS(X) \
    X(SetDebugLogging, 2, set_logging(c)) \
    X(EnterInitializationMode, 8, fmu.EnterInitializationMode(c, one_in(4), random_real(), one_in(3) ? random_real() : 0.0, one_in(8), random_real())) \
    X(ExitInitializationMode, 10, fmu.ExitInitializationMode(c)) \
    X(EnterEventMode, 8, fmu.EnterEventMode(c)) \
    X(EnterStepMode, 12, fmu.EnterStepMode(c)) \
    X(UpdateDiscreteStates, 4, fmu.UpdateDiscreteStates(c, or_null(flags), or_null(flags + 1), flags + 2, flags + 3, flags + 4, or_null(numbers))) \
    X(Terminate, 1, fmu.Terminate(c)) \
    X(Reset, 2, fmu.Reset(c)) \
    X(GetFloat64, 14, read_values(c)) \
    X(SetFloat64, 16, fmu.SetFloat64(c, REFS, or_null(numbers), room)) \
    X(GetInt32, 3, fmu.GetInt32(c, REFS, or_null(integers), room)) \
    X(SetInt32, 6, fmu.SetInt32(c, REFS, or_null(integers), room)) \
    X(Float32, 1, OTHER(c, Float32, fmi3Float32)) \
    X(Int8, 1, OTHER(c, Int8, fmi3Int8)) \
    X(UInt8, 1, OTHER(c, UInt8, fmi3UInt8)) \
    X(Int16, 1, OTHER(c, Int16, fmi3Int16)) \
    X(UInt16, 1, OTHER(c, UInt16, fmi3UInt16)) \
    X(UInt32, 1, OTHER(c, UInt32, fmi3UInt32)) \
    X(Int64, 1, OTHER(c, Int64, fmi3Int64)) \
    X(UInt64, 1, OTHER(c, UInt64, fmi3UInt64)) \
    X(Boolean, 1, one_in(2) ? fmu.GetBoolean(c, REFS, or_null(flags), room) : fmu.SetBoolean(c, REFS, or_null(flags), room)) \
    X(String, 1, one_in(2) ? fmu.GetString(c, REFS, or_null(strings), room) : fmu.SetString(c, REFS, or_null(strings), room)) \
    X(Binary, 1, one_in(2) ? fmu.GetBinary(c, REFS, or_null(sizes), or_null(binaries), room) : fmu.SetBinary(c, REFS, or_null(sizes), or_null(binaries), room)) \
    X(Clock, 1, one_in(2) ? fmu.GetClock(c, REFS, or_null(flags)) : fmu.SetClock(c, REFS, or_null(flags))) \
    X(GetFMUState, 6, fmu.GetFMUState(c, or_null(&states[below(STATES)]))) \
    X(SetFMUState, 6, fmu.SetFMUState(c, states[below(STATES)])) \
    X(FreeFMUState, 2, fmu.FreeFMUState(c, or_null(&states[below(STATES)]))) \
    X(SerializeFMUState, 6, write_state(c)) \
    X(DeserializeFMUState, 6, read_state(c)) \
    X(GetNumberOfVariableDependencies, 1, fmu.GetNumberOfVariableDependencies(c, references[0], or_null(sizes))) \
    X(GetDirectionalDerivative, 1, fmu.GetDirectionalDerivative(c, REFS, REFS, or_null(numbers), room, or_null(numbers), room)) \
    X(GetAdjointDerivative, 1, fmu.GetAdjointDerivative(c, REFS, REFS, or_null(numbers), room, or_null(numbers), room)) \
    X(EnterConfigurationMode, 1, fmu.EnterConfigurationMode(c)) \
    X(ExitConfigurationMode, 1, fmu.ExitConfigurationMode(c)) \
    X(EvaluateDiscreteStates, 1, fmu.EvaluateDiscreteStates(c)) \
    X(EnterContinuousTimeMode, 1, fmu.EnterContinuousTimeMode(c)) \
    X(SetTime, 1, fmu.SetTime(c, random_real())) \
    X(SetContinuousStates, 1, fmu.SetContinuousStates(c, or_null(numbers), count)) \
    X(GetContinuousStates, 1, fmu.GetContinuousStates(c, or_null(numbers), count)) \
    X(GetEventIndicators, 1, fmu.GetEventIndicators(c, or_null(numbers), count)) \
    X(GetNumberOfEventIndicators, 1, fmu.GetNumberOfEventIndicators(c, or_null(sizes))) \
    X(GetNumberOfContinuousStates, 1, fmu.GetNumberOfContinuousStates(c, or_null(sizes))) \
    X(GetOutputDerivatives, 1, fmu.GetOutputDerivatives(c, REFS, or_null(integers), or_null(numbers), room)) \
    X(GetIntervalDecimal, 1, fmu.GetIntervalDecimal(c, REFS, or_null(numbers), or_null(integers))) \
    X(SetIntervalDecimal, 1, fmu.SetIntervalDecimal(c, REFS, or_null(numbers))) \
    X(ActivateModelPartition, 1, fmu.ActivateModelPartition(c, references[0], random_real())) \
    X(DoStep, 26, step(c))

#define ROW(name, weight, call) {"fmi3" #name, weight},
static const Function FUNCTION[] = {FUNCTIONS(ROW)};
#undef ROW

enum { FUNCTION_COUNT = sizeof FUNCTION / sizeof *FUNCTION };

static fmi3Status call(unsigned function, fmi3Instance c) {
    unsigned index = 0;
    size_t count = random_count(), room = one_in(10) ? random_count() : count;
#define CASE(name, weight, call) if (function == index++) return call;
    FUNCTIONS(CASE)
#undef CASE
    return fmi3Fatal;
}

static void judge_refusal(fmi3Status status, fmi3Instance instance) {
    if (status != fmi3Error) fail("a status that is neither fmi3OK nor fmi3Error");
    if (instance && !messages) fail("refused, but not logged");
}

int main(int count, char **arguments) {
    if (count != 7 || !load(arguments[1])) return COULD_NOT_RUN;
    token = arguments[2];
    random_state = 2 * strtoull(arguments[3], NULL, 10) + 1;
    settable = (unsigned)strtoul(arguments[5], NULL, 10);
    seconds = strtod(arguments[6], NULL);
    fuzz(strtoul(arguments[4], NULL, 10), FUNCTION, FUNCTION_COUNT, "Int32");
    return 0;
}
