/* Restores states of any content with a valid seal, then steps and reads everything.
 *
 *     states LIBRARY GUID SEED CASES SECONDS
 *
 * The variables that can be set and the life cycle end a state; the numbers before them are its fields.
 * Each case takes the state of some device in motion, changes a few of its numbers, seals it anew and
 * restores it; what is refused is left, what is accepted is stepped, read and stored again. Fails (1)
 * when an output that is read with fmi2OK is not finite, when an accepted state cannot be stored, or
 * when a call takes more than SECONDS of processor time. Ends with a line of what was done. */
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "fmu_library.h"
#include "random_values.h"
#include "variables.h"

enum { HEADER = 48, NUMBER = 8, END = 12, MAX_BYTES = 8192, STEPS = 3 };

static FmuLibrary fmu;
static double longest = 0.0, seconds;
static double numbers[MAX_BYTES / NUMBER]; /* of the state that is tried */
static int fields = 0;
static long present_case = 0;
static long restored = 0, stepped = 0, read_out = 0;

static void log_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                        fmi2String category, fmi2String message, ...) {
    (void)environment, (void)instance, (void)status, (void)category, (void)message;
}

/* FNV-1a, as the component seals its states. */
static void seal(fmi2Byte *bytes, size_t size) {
    uint64_t sum = UINT64_C(14695981039346656037);
    size_t i, checked = size - NUMBER;
    for (i = 0; i < checked; i++) sum = (sum ^ (unsigned char)bytes[i]) * UINT64_C(1099511628211);
    memcpy(bytes + checked, &sum, sizeof sum);
}

static void fail(const char *what) {
    int i;
    printf("case %ld: %s\n", present_case, what);
    for (i = 0; i < fields + SETTABLE_COUNT; i++) printf("%d %.17g\n", i, numbers[i]);
    exit(1);
}

static void timed(clock_t began, const char *what) {
    double taken = (double)(clock() - began) / CLOCKS_PER_SEC;
    if (taken > longest) longest = taken;
    if (taken > seconds) fail(what);
}

static double odd_number(double before) {
    static const double powers[] = {1e-300, 1e-20, 1e-6, 0.5, 1.0 + 1e-15, 2.0, 1e3, 1e12, 1e200};
    if (one_in(3)) return before * powers[below(sizeof powers / sizeof *powers)];
    if (one_in(4)) return -before;
    return one_in(2) ? random_real() : (random_share() - 0.5) * 20.0;
}

/* Some turns of the fastest frequency that was asked for, so that work does not grow with it. */
static double step_size(void) {
    const double *values = numbers + fields;
    double drive = values[VR_DRIVE_FREQUENCY], fastest = drive;
    double free = sqrt(1.0 + values[VR_RESONATOR_MASS] / values[VR_SLIDER_MASS]);
    fastest = fmax(fastest, fabs(drive * values[VR_FREQUENCY_RATIO]));
    fastest = fmax(fastest, free * values[VR_RESONATOR_FREQUENCY]);
    return 20.0 * random_share() * random_share() / fastest;
}

static void start(fmi2Component c) {
    static const fmi2ValueReference choices[] = {VR_FRICTION_LAW, VR_FIDELITY, VR_FRICTION_FACES, VR_AVERAGING_ORDER};
    static const fmi2ValueReference reals[] = {VR_FREQUENCY_RATIO, VR_NORMAL_AMPLITUDE};
    static const double ratios[] = {1.0, 2.0, -1.0, 0.0, 0.5, 1.01, 0.003, 1.37};
    static const double amplitudes[] = {1.0, 0.0, 0.7, 3.0};
    const fmi2Integer chosen[] = {(fmi2Integer)below(2), (fmi2Integer)below(3),
                                  (fmi2Integer)(1 + below(2)), (fmi2Integer)(1 + below(2))};
    const fmi2Real values[] = {ratios[below(8)], amplitudes[below(4)]};
    int i;
    fmu.Reset(c);
    fmu.SetInteger(c, choices, 4, chosen);
    fmu.SetReal(c, reals, 2, values);
    fmu.SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    fmu.EnterInitializationMode(c);
    fmu.ExitInitializationMode(c);
    for (i = (int)below(4); i > 0; i--) {
        fmi2Real now = 0.0;
        fmu.GetRealStatus(c, fmi2LastSuccessfulTime, &now);
        fmu.DoStep(c, now, 1e-3 * random_share(), fmi2True);
    }
}

static size_t stored(fmi2Component c, fmi2Byte bytes[MAX_BYTES]) {
    fmi2FMUstate state = NULL;
    size_t size = 0;
    if (fmu.GetFMUstate(c, &state) != fmi2OK) return 0;
    fmu.SerializedFMUstateSize(c, state, &size);
    if (size > MAX_BYTES || fmu.SerializeFMUstate(c, state, bytes, size) != fmi2OK) size = 0;
    fmu.FreeFMUstate(c, &state);
    return size;
}

static int restore(fmi2Component c, const fmi2Byte *bytes, size_t size) {
    fmi2FMUstate state = NULL;
    int done = fmu.DeSerializeFMUstate(c, bytes, size, &state) == fmi2OK
               && fmu.SetFMUstate(c, state) == fmi2OK;
    if (state) fmu.FreeFMUstate(c, &state);
    return done;
}

static void read_all(fmi2Component c) {
    fmi2ValueReference reference;
    for (reference = 0; reference < VARIABLE_COUNT; reference++) {
        fmi2Real value = 0.0;
        clock_t began = clock();
        if (fmu.GetReal(c, &reference, 1, &value) == fmi2OK) { /* not for Integers */
            if (!isfinite(value)) fail("an output that is not finite");
            read_out++;
        }
        timed(began, "reading takes too long");
    }
}

static void try_case(fmi2Component c) {
    fmi2Byte bytes[MAX_BYTES];
    size_t size;
    int changes, step;
    start(c);
    size = stored(c, bytes);
    if (size == 0) fail("a state could not be stored");
    fields = (int)((size - HEADER - END) / NUMBER) - SETTABLE_COUNT;
    memcpy(numbers, bytes + HEADER, size - HEADER - END);
    for (changes = 1 + (int)below(4); changes > 0; changes--) {
        double *number = &numbers[below((unsigned)(fields + SETTABLE_COUNT))];
        *number = odd_number(*number);
    }
    memcpy(bytes + HEADER, numbers, size - HEADER - END);
    seal(bytes, size);
    if (!restore(c, bytes, size)) return;
    restored++;
    for (step = 0; step < STEPS; step++) {
        fmi2Real now = 0.0;
        clock_t began;
        read_all(c);
        fmu.GetRealStatus(c, fmi2LastSuccessfulTime, &now);
        began = clock();
        stepped += fmu.DoStep(c, now, step_size(), fmi2True) == fmi2OK;
        timed(began, "a step takes too long");
    }
    read_all(c);
    if (stored(c, bytes) != size) fail("a state could not be stored again");
}

int main(int count, char **arguments) {
    static const fmi2CallbackFunctions callbacks = {log_message, calloc, free, NULL, NULL};
    fmi2Component c;
    long cases;
    if (count != 6 || !load_fmu_library(&fmu, arguments[1])) return 2;
    random_state = 2 * strtoull(arguments[3], NULL, 10) + 1;
    cases = strtol(arguments[4], NULL, 10);
    seconds = strtod(arguments[5], NULL);
    c = fmu.Instantiate("states", fmi2CoSimulation, arguments[2], "file:///nowhere", &callbacks,
                        fmi2False, fmi2False);
    if (!c) return 2;
    for (; present_case < cases; present_case++) try_case(c);
    fmu.FreeInstance(c);
    printf("%ld states: %ld restored, %ld steps, %ld values read, longest call %.3f s\n", cases,
           restored, stepped, read_out, longest);
    return 0;
}
