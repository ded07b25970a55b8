/* Calls all functions of an FMU in random order with good, bad and absurd arguments.
 *
 *     fuzz LIBRARY GUID SEED CALLS [SETTABLE]
 *
 * SETTABLE is the number of variables that can be set, that of the slider unless it is given.
 *
 * Fails (1) when a call that is not carried out goes unlogged, is logged with another status, changes
 * the state, or answers a status that no host should see there; when an output that is read with fmi2OK
 * is not finite; when a call exceeds two seconds; when memory is left behind. A crash or a hang speaks for
 * itself. Ends with a line of what was done, and for each function how often it was called and carried out. */
#include <stdarg.h>

#include "fmu_library.h"

typedef fmi2Component Instance;
typedef fmi2FMUstate State;
typedef fmi2Byte Byte;
typedef fmi2Status Status;
typedef fmi2ValueReference Reference;
typedef fmi2Integer Integer;
typedef fmi2String String;
enum { FIRST = 0, MEMORY_MAY_RUN_OUT = 1 };

static FmuLibrary fmu;

#define GET_REALS fmu.GetReal
#include "fuzzing.h"

static const char *guid;

static long blocks_in_use = 0;

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
    messages++;
    said.status = status;
}

static const fmi2CallbackFunctions CALLBACKS = {log_message, allocate, release, NULL, &said};

static fmi2String some_name(void) {
    static const char *const names[] = {"slider", "", "a name with %s and %n in it"};
    return one_in(10) ? NULL : names[one_in(4) ? below(3) : 0];
}

static void instantiate(unsigned slot) {
    fmi2Type type = one_in(10) ? (fmi2Type)random_integer() : fmi2CoSimulation;
    fmi2String given = one_in(10) ? some_name() : guid;
    const fmi2CallbackFunctions *callbacks = one_in(50) ? NULL : &CALLBACKS;
    fmi2Component made;
    if (instances[slot]) fmu.FreeInstance(instances[slot]);
    present_call = "fmi2Instantiate";
    messages = 0;
    made = fmu.Instantiate(some_name(), type, given, one_in(2) ? NULL : "file:///nowhere",
                           callbacks, fmi2False, one_in(20) ? fmi2False : fmi2True);
    if (!made && callbacks && !messages) fail("no instance, and no word why");
    instances[slot] = made;
    if (made) fmu.SetDebugLogging(made, fmi2True, 0, NULL);
}

static fmi2Status do_step(fmi2Component c) {
    fmi2Real now = 0.0;
    fmu.GetRealStatus(c, fmi2LastSuccessfulTime, &now);
    if (one_in(20)) now = random_real();
    return fmu.DoStep(c, now, random_step(), below(2));
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
    X(fmi2GetFMUstate, 6, fmu.GetFMUstate(c, or_null(&states[below(STATES)]))) \
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

int main(int count, char **arguments) {
    if ((count != 5 && count != 6) || !load_fmu_library(&fmu, arguments[1])) return COULD_NOT_RUN;
    guid = arguments[2];
    random_state = 2 * strtoull(arguments[3], NULL, 10) + 1;
    if (count == 6) settable = (unsigned)strtoul(arguments[5], NULL, 10);
    fuzz(strtoul(arguments[4], NULL, 10), FUNCTION, FUNCTION_COUNT, "Integer");
    present_call = "after all calls";
    if (blocks_in_use) fail("memory is left behind");
    return 0;
}
