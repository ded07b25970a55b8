/* Lives of instances: many one after the other, or in as many threads at once.
 *
 *     instances LIBRARY GUID COUNT
 *     instances LIBRARY GUID THREADS STEPS
 *
 * Each has a law, fidelity, phase and load of its own, takes steps of 1 ms, is refused one, and hands its stored state
 * on to a second instance half-way. The first form prints the resident memory [kB] after a tenth of COUNT and at the
 * end. The second repeats each life alone: the outputs must be the same. Fails (1) when a call is not answered as it
 * should be, outputs differ, or blocks are left behind. */
#include <pthread.h>
#include <stdlib.h>

#include "fmu_library.h"
#include "variables.h"

enum { FAILED = 1, COULD_NOT_RUN = 2, MAX_THREADS = 64, MAX_BYTES = 8192 };
enum { OUTPUTS = VARIABLE_COUNT - SETTABLE_COUNT, LAWS = 2, FIDELITIES = 3 };

typedef struct {
    int number;
    fmi2Real outputs[OUTPUTS];
} Life;

static FmuLibrary fmu;
static const char *guid;
static int steps = 2;
static long blocks_in_use = 0;

static void *allocate(size_t count, size_t size) {
    __sync_fetch_and_add(&blocks_in_use, 1);
    return calloc(count, size);
}

static void release(void *block) {
    if (block) __sync_fetch_and_sub(&blocks_in_use, 1);
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

#define DO(name, ...) expect(fmu.name(__VA_ARGS__) == fmi2OK, "fmi2" #name)

static fmi2Component start(int number) {
    static const fmi2CallbackFunctions callbacks = {log_message, allocate, release, NULL, NULL};
    const fmi2ValueReference choices[] = {VR_FRICTION_LAW, VR_FIDELITY}, inputs[] = {VR_PHASE, VR_LOAD};
    const fmi2Integer chosen[] = {number % LAWS, FIDELITIES - 1 - number / LAWS % FIDELITIES};
    const fmi2Real values[] = {0.4 + 0.1 * (number % MAX_THREADS), 0.01 * (number % MAX_THREADS)};
    fmi2Component c = fmu.Instantiate("one of many", fmi2CoSimulation, guid, "file:///nowhere",
                                      &callbacks, fmi2False, fmi2True);
    expect(c != NULL, "fmi2Instantiate");
    DO(SetInteger, c, choices, 2, chosen);
    DO(SetReal, c, inputs, 2, values);
    DO(SetupExperiment, c, fmi2False, 0.0, 0.0, fmi2False, 0.0);
    DO(EnterInitializationMode, c);
    DO(ExitInitializationMode, c);
    return c;
}

static void hand_on(fmi2Component from, fmi2Component to) {
    fmi2Byte bytes[MAX_BYTES];
    fmi2FMUstate state = NULL;
    size_t size = 0;
    DO(GetFMUstate, from, &state);
    DO(SerializedFMUstateSize, from, state, &size);
    expect(size <= MAX_BYTES, "fmi2SerializedFMUstateSize");
    DO(SerializeFMUstate, from, state, bytes, size);
    DO(FreeFMUstate, from, &state);
    DO(DeSerializeFMUstate, to, bytes, size, &state);
    DO(SetFMUstate, to, state);
    DO(FreeFMUstate, to, &state);
}

static void *live(void *argument) {
    Life *life = argument;
    fmi2ValueReference references[OUTPUTS];
    fmi2Component first = start(life->number), second = start(life->number);
    int i;
    for (i = 0; i < OUTPUTS; i++) references[i] = (fmi2ValueReference)(SETTABLE_COUNT + i);
    for (i = 0; i < steps; i++) {
        DO(DoStep, i < steps / 2 ? first : second, 1e-3 * i, 1e-3, fmi2True);
        if (i + 1 == steps / 2) hand_on(first, second);
    }
    expect(fmu.DoStep(second, 1e6, 1e-3, fmi2True) == fmi2Error, "fmi2DoStep, refused");
    DO(GetReal, second, references, OUTPUTS, life->outputs);
    expect(life->number % 2 || !fmu.Terminate(second), "fmi2Terminate");
    fmu.FreeInstance(first);
    fmu.FreeInstance(second);
    return NULL;
}

static void live_in_turn(int count) {
    Life life;
    for (life.number = 0; life.number < count; life.number++) {
        if (life.number == count / 20) resident_kilobytes(); /* The first reading takes a place in the heap. */
        if (life.number == count / 10) printf("%ld ", resident_kilobytes());
        live(&life);
    }
    printf("%ld\n", resident_kilobytes());
}

static void live_at_once(int count) {
    static Life together[MAX_THREADS], alone[MAX_THREADS];
    pthread_t threads[MAX_THREADS];
    int number;
    for (number = 0; number < count; number++) {
        together[number].number = alone[number].number = number;
        expect(!pthread_create(&threads[number], NULL, live, &together[number]), "pthread_create");
    }
    for (number = 0; number < count; number++) pthread_join(threads[number], NULL);
    for (number = 0; number < count; number++) {
        live(&alone[number]);
        expect(!memcmp(together[number].outputs, alone[number].outputs, sizeof alone->outputs),
               "a thread with other numbers than alone");
    }
}

int main(int count, char **arguments) {
    int lives;
    if (count < 4 || count > 5 || !load_fmu_library(&fmu, arguments[1])) return COULD_NOT_RUN;
    guid = arguments[2];
    lives = atoi(arguments[3]);
    if (count == 4) {
        live_in_turn(lives);
    } else {
        steps = atoi(arguments[4]);
        if (lives < 1 || lives > MAX_THREADS) return COULD_NOT_RUN;
        live_at_once(lives);
    }
    if (blocks_in_use) printf("%ld blocks left behind\n", blocks_in_use);
    return blocks_in_use ? FAILED : 0;
}
