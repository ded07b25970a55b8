/* Calls all functions of an FMU of FMI 3.0 in random order with good, bad and absurd arguments.
 *
 *     fuzz3 LIBRARY TOKEN SEED CALLS SECONDS
 *
 * The references from 2 on are those of the variables; 1 is the time.
 *
 * Fails (1) when a call that is not carried out goes unlogged, changes the state, or answers anything
 * but fmi3Error; when an output that is read with fmi3OK is not finite; when a call takes more than
 * SECONDS of processor time. A crash or a hang speaks for itself. Ends with a line of what was done,
 * and for each function how often it was called and carried out. */
#include "fmi3FunctionTypes.h"
#include "fmu_library.h"

typedef fmi3Instance Instance;
typedef fmi3FMUState State;
typedef fmi3Byte Byte;
typedef fmi3Status Status;
typedef fmi3ValueReference Reference;
typedef fmi3Int32 Integer;
typedef fmi3String String;
enum { FIRST = 2, MEMORY_MAY_RUN_OUT = 0 };

#define REFS or_null(references), count
#define OTHER(X, name, array) \
    X(Get##name, 1, fmu.Get##name(c, REFS, or_null(array), room)) \
    X(Set##name, 1, fmu.Set##name(c, REFS, or_null(array), room))

/* Name, weight, call: `c` is an instance or a null pointer. */
#define FUNCTIONS(X) \
    X(SetDebugLogging, 2, set_logging(c)) \
    X(EnterInitializationMode, 8, fmu.EnterInitializationMode(c, one_in(4), random_real(), one_in(3) ? random_real() : 0.0, one_in(8), random_real())) \
    X(ExitInitializationMode, 10, fmu.ExitInitializationMode(c)) \
    X(EnterEventMode, 8, fmu.EnterEventMode(c)) \
    X(EnterStepMode, 12, fmu.EnterStepMode(c)) \
    X(UpdateDiscreteStates, 4, fmu.UpdateDiscreteStates(c, or_null(flags), or_null(flags + 1), flags + 2, flags + 3, flags + 4, or_null(reals))) \
    X(Terminate, 1, fmu.Terminate(c)) \
    X(Reset, 2, fmu.Reset(c)) \
    X(GetFloat64, 14, read_values(c)) \
    X(SetFloat64, 16, fmu.SetFloat64(c, REFS, or_null(reals), room)) \
    X(GetInt32, 3, fmu.GetInt32(c, REFS, or_null(integers), room)) \
    X(SetInt32, 6, fmu.SetInt32(c, REFS, or_null(integers), room)) \
    OTHER(X, Float32, reals) OTHER(X, Int8, reals) OTHER(X, UInt8, reals) OTHER(X, Int16, reals) \
    OTHER(X, UInt16, reals) OTHER(X, UInt32, reals) OTHER(X, Int64, reals) OTHER(X, UInt64, reals) \
    OTHER(X, Boolean, flags) OTHER(X, String, strings) \
    X(GetBinary, 1, fmu.GetBinary(c, REFS, or_null(sizes), or_null(binaries), room)) \
    X(SetBinary, 1, fmu.SetBinary(c, REFS, or_null(sizes), or_null(binaries), room)) \
    X(GetClock, 1, fmu.GetClock(c, REFS, or_null(flags))) \
    X(SetClock, 1, fmu.SetClock(c, REFS, or_null(flags))) \
    X(GetFMUState, 6, fmu.GetFMUState(c, or_null(&states[below(STATES)]))) \
    X(SetFMUState, 6, fmu.SetFMUState(c, states[below(STATES)])) \
    X(FreeFMUState, 2, fmu.FreeFMUState(c, or_null(&states[below(STATES)]))) \
    X(SerializeFMUState, 6, write_state(c)) \
    X(DeserializeFMUState, 6, read_state(c)) \
    X(GetNumberOfVariableDependencies, 1, fmu.GetNumberOfVariableDependencies(c, references[0], or_null(sizes))) \
    X(GetDirectionalDerivative, 1, fmu.GetDirectionalDerivative(c, REFS, REFS, or_null(reals), room, or_null(reals), room)) \
    X(GetAdjointDerivative, 1, fmu.GetAdjointDerivative(c, REFS, REFS, or_null(reals), room, or_null(reals), room)) \
    X(EnterConfigurationMode, 1, fmu.EnterConfigurationMode(c)) \
    X(ExitConfigurationMode, 1, fmu.ExitConfigurationMode(c)) \
    X(EvaluateDiscreteStates, 1, fmu.EvaluateDiscreteStates(c)) \
    X(EnterContinuousTimeMode, 1, fmu.EnterContinuousTimeMode(c)) \
    X(SetTime, 1, fmu.SetTime(c, random_real())) \
    X(SetContinuousStates, 1, fmu.SetContinuousStates(c, or_null(reals), count)) \
    X(GetContinuousStates, 1, fmu.GetContinuousStates(c, or_null(reals), count)) \
    X(GetEventIndicators, 1, fmu.GetEventIndicators(c, or_null(reals), count)) \
    X(GetNumberOfEventIndicators, 1, fmu.GetNumberOfEventIndicators(c, or_null(sizes))) \
    X(GetNumberOfContinuousStates, 1, fmu.GetNumberOfContinuousStates(c, or_null(sizes))) \
    X(GetOutputDerivatives, 1, fmu.GetOutputDerivatives(c, REFS, or_null(integers), or_null(reals), room)) \
    X(GetIntervalDecimal, 1, fmu.GetIntervalDecimal(c, REFS, or_null(reals), or_null(integers))) \
    X(SetIntervalDecimal, 1, fmu.SetIntervalDecimal(c, REFS, or_null(reals))) \
    X(ActivateModelPartition, 1, fmu.ActivateModelPartition(c, references[0], random_real())) \
    X(DoStep, 26, step(c))

/* Others that are called. */
#define OTHERS(X) \
    X(InstantiateCoSimulation, 0) X(InstantiateModelExchange, 0) X(InstantiateScheduledExecution, 0) \
    X(FreeInstance, 0) X(SerializedFMUStateSize, 0)

static struct {
#define MEMBER(name, ...) fmi3##name##TYPE *name;
    OTHERS(MEMBER)
    FUNCTIONS(MEMBER)
#undef MEMBER
} fmu;

static int load(const char *path) {
    void *handle = open_library(path);
    int complete = handle != NULL;
    (void)load_fmu_library; /* that of FMI 2.0 */
    if (!complete) return 0;
#define FIND(name, ...) complete &= find_function(handle, "fmi3" #name, &fmu.name, sizeof fmu.name);
    OTHERS(FIND)
    FUNCTIONS(FIND)
#undef FIND
    return complete;
}

#define GetFMUstate GetFMUState
#define FreeFMUstate FreeFMUState
#define SerializedFMUstateSize SerializedFMUStateSize
#define SerializeFMUstate SerializeFMUState
#define DeSerializeFMUstate DeserializeFMUState
#define GET_REALS(c, references, count, values) \
    fmu.GetFloat64(c, references, count, values, one_in(10) ? random_count() : count)
#include "fuzzing.h"

static const char *token;

static fmi3Binary binaries[ROOM];
static size_t sizes[ROOM];
static bool flags[ROOM];

static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                        fmi3String message) {
    if (environment != &said) fail("the logger was called with another environment");
    if (!category || !message || !*message) fail("the logger was called without a message");
    snprintf(said.text, sizeof said.text, "%s", message);
    said.status = status;
    messages++;
}

static void instantiate(unsigned slot) {
    fmi3String name = one_in(10) ? NULL : "slider %s %n", given = one_in(10) ? NULL : token;
    size_t intermediate = one_in(20) ? random_count() : 0;
    fmi3Instance made;
    if (instances[slot]) fmu.FreeInstance(instances[slot]);
    present_call = "fmi3InstantiateCoSimulation";
    messages = 0;
    made = fmu.InstantiateCoSimulation(name, given, one_in(2) ? NULL : "nowhere", one_in(2), true,
                                       !one_in(3), !one_in(3), NULL, intermediate, &said,
                                       log_message, NULL);
    if (!made && !messages) fail("no instance, and no word why");
    if (made && fmu.SetDebugLogging(made, true, 0, NULL) != fmi3OK) fail("logging is refused");
    instances[slot] = made;
    if (fmu.InstantiateModelExchange(name, token, NULL, false, true, &said, log_message)
        || fmu.InstantiateScheduledExecution(name, token, NULL, false, true, &said, log_message,
                                             NULL, NULL, NULL)) {
        fail("an instance of a kind that is not offered");
    }
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

#define ROW(name, weight, call) {"fmi3" #name, weight},
static const Function FUNCTION[] = {FUNCTIONS(ROW)};
#undef ROW

enum { FUNCTION_COUNT = sizeof FUNCTION / sizeof *FUNCTION };

static fmi3Status call(unsigned function, fmi3Instance c) {
    unsigned index = 0;
    size_t i, count = random_count(), room = one_in(10) ? random_count() : count;
    for (i = 0; i < ROOM; i++) {
        binaries[i] = one_in(2) ? NULL : stored;
        sizes[i] = random_count();
        flags[i] = one_in(2);
    }
#define CASE(name, weight, call) if (function == index++) return call;
    FUNCTIONS(CASE)
#undef CASE
    return fmi3Fatal;
}

int main(int count, char **arguments) {
    if (count != 6 || !load(arguments[1])) return COULD_NOT_RUN;
    token = arguments[2];
    random_state = 2 * strtoull(arguments[3], NULL, 10) + 1;
    seconds = strtod(arguments[5], NULL);
    fuzz(strtoul(arguments[4], NULL, 10), FUNCTION, FUNCTION_COUNT, "Int32");
    return 0;
}
