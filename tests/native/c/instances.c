/* Makes, runs and frees instances, one after the other, and prints the memory that the process holds.
 *
 *     instances LIBRARY GUID COUNT
 *
 * Prints the resident memory [kB] after a tenth of COUNT and at the end. Each instance takes one step
 * with another law or fidelity, gets, serialises and sets its state, and is refused something. Fails
 * (1) when a call is not answered as it should be, or blocks are left behind. */
#include <stdlib.h>

#include "fmu_library.h"
#include "variables.h"

enum { FAILED = 1, COULD_NOT_RUN = 2, LAWS = 2, FIDELITIES = 3 };
enum { MAX_BYTES = 8192 };

static long blocks_in_use = 0;

static void *allocate(size_t count, size_t size) {
    blocks_in_use++;
    return calloc(count, size);
}

static void release(void *block) {
    if (block) blocks_in_use--;
    free(block);
}

static void log_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                        fmi2String category, fmi2String message, ...) {
    (void)environment, (void)instance, (void)status, (void)category, (void)message;
}

static long resident_kilobytes(void) {
    char line[256];
    long kilobytes = -1;
    FILE *file = fopen("/proc/self/status", "r");
    while (file && fgets(line, sizeof line, file))
        if (sscanf(line, "VmRSS: %ld", &kilobytes) == 1) break;
    if (file) fclose(file);
    return kilobytes;
}

static void expect(int as_it_should, const char *what) {
    if (as_it_should) return;
    printf("%s: not answered as it should be\n", what);
    exit(FAILED);
}

static void live(const FmuLibrary *fmu, const char *guid, long number) {
    static const fmi2CallbackFunctions callbacks = {log_message, allocate, release, NULL, NULL};
    const fmi2ValueReference choices[] = {VR_FRICTION_LAW, VR_FIDELITY};
    const fmi2Integer values[] = {(fmi2Integer)(number % LAWS),
                                  (fmi2Integer)(number / LAWS % FIDELITIES)};
    const fmi2ValueReference load = VR_LOAD, velocity = VR_VELOCITY;
    const fmi2Real nothing = 0.0, too_late = 2.0;
    fmi2Byte bytes[MAX_BYTES];
    fmi2FMUstate state = NULL;
    size_t size = 0;
    fmi2Real value;
    fmi2Component c = fmu->Instantiate("one of many", fmi2CoSimulation, guid, "file:///nowhere",
                                       &callbacks, fmi2False, fmi2True);
    expect(c != NULL, "fmi2Instantiate");
    expect(!fmu->SetInteger(c, choices, 2, values), "fmi2SetInteger");
    expect(!fmu->SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0), "fmi2SetupExperiment");
    expect(!fmu->EnterInitializationMode(c), "fmi2EnterInitializationMode");
    expect(!fmu->ExitInitializationMode(c), "fmi2ExitInitializationMode");
    expect(!fmu->SetReal(c, &load, 1, &nothing), "fmi2SetReal");
    expect(!fmu->DoStep(c, 0.0, 1e-3, fmi2True), "fmi2DoStep");
    expect(fmu->DoStep(c, too_late, 1e-3, fmi2True) == fmi2Error, "fmi2DoStep, refused");
    expect(!fmu->GetReal(c, &velocity, 1, &value), "fmi2GetReal");
    expect(!fmu->GetFMUstate(c, &state), "fmi2GetFMUstate");
    expect(!fmu->SerializedFMUstateSize(c, state, &size), "fmi2SerializedFMUstateSize");
    expect(size <= MAX_BYTES && !fmu->SerializeFMUstate(c, state, bytes, size),
           "fmi2SerializeFMUstate");
    expect(!fmu->FreeFMUstate(c, &state), "fmi2FreeFMUstate");
    expect(!fmu->DeSerializeFMUstate(c, bytes, size, &state), "fmi2DeSerializeFMUstate");
    expect(!fmu->SetFMUstate(c, state), "fmi2SetFMUstate");
    expect(!fmu->FreeFMUstate(c, &state), "fmi2FreeFMUstate");
    expect(number % 2 || !fmu->Terminate(c), "fmi2Terminate");
    fmu->FreeInstance(c);
}

int main(int count, char **arguments) {
    FmuLibrary fmu;
    long number, requested;
    if (count != 4 || !load_fmu_library(&fmu, arguments[1])) return COULD_NOT_RUN;
    requested = strtol(arguments[3], NULL, 10);
    for (number = 0; number < requested; number++) {
        if (number == requested / 20) resident_kilobytes(); /* The first reading takes a place in the heap. */
        if (number == requested / 10) printf("%ld ", resident_kilobytes());
        live(&fmu, arguments[2], number);
    }
    printf("%ld\n", resident_kilobytes());
    if (blocks_in_use) printf("%ld blocks left behind\n", blocks_in_use);
    return blocks_in_use ? FAILED : 0;
}
