/* The smallest host there is: runs one instance of an FMU by commands from standard input.
 *
 *     driver LIBRARY GUID RESOURCES < COMMANDS
 *
 *     integer REFERENCE VALUE     sets an Integer
 *     real REFERENCE VALUE        sets a Real
 *     initialize                  ends initialisation; time starts at 0
 *     reset                       goes back to before initialisation
 *     step SIZE COUNT             takes COUNT steps of SIZE seconds
 *     get REFERENCE...            prints Reals on one line
 *     time COUNT SIZE             prints the microseconds that a step takes, over COUNT steps of
 *                                 SIZE seconds
 *     time COUNT SIZE INPUT VALUE OUTPUT...
 *                                 the same, each with setting INPUT to a millionth of VALUE more
 *                                 than before and getting the OUTPUTs
 *
 * Ends with 0; with 1 and a message when the FMU refuses a call or leaves memory behind; with 2 when
 * it cannot be loaded or a command is not understood. C99 and the operating system's loader only. */
#include <stdarg.h>
#include <stdlib.h>
#include <time.h>

#include "fmu_library.h"

enum { LONGEST_LINE = 4096, MAX_REFERENCES = 64, REFUSED = 1, NOT_UNDERSTOOD = 2 };

static size_t blocks_in_use = 0;

static void *allocate(size_t count, size_t size) {
    void *block = calloc(count, size);
    if (block) blocks_in_use++;
    return block;
}

static void release(void *block) {
    if (block) blocks_in_use--;
    free(block);
}

static void log_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status,
                        fmi2String category, fmi2String message, ...) {
    va_list arguments;
    (void)environment;
    fprintf(stderr, "%s [%s, status %d]: ", instance, category, (int)status);
    va_start(arguments, message);
    vfprintf(stderr, message, arguments);
    va_end(arguments);
    fputc('\n', stderr);
}

typedef struct {
    FmuLibrary fmu;
    fmi2Component instance;
    double time;
} Host;

static void check(fmi2Status status, const char *call) {
    if (status == fmi2OK) return;
    fprintf(stderr, "%s: status %d\n", call, (int)status);
    exit(REFUSED);
}

static void set_up(Host *host) {
    check(host->fmu.SetupExperiment(host->instance, fmi2False, 0.0, 0.0, fmi2False, 0.0),
          "fmi2SetupExperiment");
    host->time = 0.0;
}

static void initialize(Host *host) {
    check(host->fmu.EnterInitializationMode(host->instance), "fmi2EnterInitializationMode");
    check(host->fmu.ExitInitializationMode(host->instance), "fmi2ExitInitializationMode");
}

static void step(Host *host, double size) {
    check(host->fmu.DoStep(host->instance, host->time, size, fmi2True), "fmi2DoStep");
    host->time += size;
}

static size_t read_references(fmi2ValueReference references[MAX_REFERENCES]) {
    size_t count = 0;
    const char *word;
    while (count < MAX_REFERENCES && (word = strtok(NULL, " \r\n")) != NULL)
        references[count++] = (fmi2ValueReference)strtoul(word, NULL, 10);
    return count;
}

static double read_number(void) {
    const char *word = strtok(NULL, " \r\n");
    char *end = NULL;
    double number = word ? strtod(word, &end) : 0.0;
    if (!word || *end) {
        fprintf(stderr, "%s is not a number\n", word ? word : "what is missing");
        exit(NOT_UNDERSTOOD);
    }
    return number;
}

static void get(const Host *host) {
    fmi2ValueReference references[MAX_REFERENCES];
    fmi2Real values[MAX_REFERENCES];
    size_t i, count = read_references(references);
    check(host->fmu.GetReal(host->instance, references, count, values), "fmi2GetReal");
    for (i = 0; i < count; i++) printf("%s%.17g", i ? " " : "", values[i]);
    putchar('\n');
}

static void time_steps(Host *host) {
    fmi2ValueReference references[MAX_REFERENCES], input = 0;
    fmi2Real first = 0.0, value, values[MAX_REFERENCES];
    long i, steps = (long)read_number();
    double size = read_number();
    size_t count = 0;
    clock_t began;
    const char *word = strtok(NULL, " \r\n");
    if (word) {
        input = (fmi2ValueReference)strtoul(word, NULL, 10);
        first = read_number();
        count = read_references(references);
    }
    began = clock();
    for (i = 0; i < steps; i++) {
        if (!word) {
            step(host, size);
            continue;
        }
        value = first * (1.0 + 1e-6 * (double)i);
        check(host->fmu.SetReal(host->instance, &input, 1, &value), "fmi2SetReal");
        step(host, size);
        check(host->fmu.GetReal(host->instance, references, count, values), "fmi2GetReal");
    }
    printf("%.6g\n", 1e6 * (double)(clock() - began) / CLOCKS_PER_SEC / (double)steps);
}

static void obey(Host *host, const char *command) {
    if (!strcmp(command, "integer")) {
        fmi2ValueReference reference = (fmi2ValueReference)read_number();
        fmi2Integer value = (fmi2Integer)read_number();
        check(host->fmu.SetInteger(host->instance, &reference, 1, &value), "fmi2SetInteger");
    } else if (!strcmp(command, "real")) {
        fmi2ValueReference reference = (fmi2ValueReference)read_number();
        fmi2Real value = read_number();
        check(host->fmu.SetReal(host->instance, &reference, 1, &value), "fmi2SetReal");
    } else if (!strcmp(command, "initialize")) {
        initialize(host);
    } else if (!strcmp(command, "reset")) {
        check(host->fmu.Reset(host->instance), "fmi2Reset");
        set_up(host);
    } else if (!strcmp(command, "step")) {
        double size = read_number();
        long count = (long)read_number();
        while (count-- > 0) step(host, size);
    } else if (!strcmp(command, "get")) {
        get(host);
    } else if (!strcmp(command, "time")) {
        time_steps(host);
    } else {
        fprintf(stderr, "%s is no command\n", command);
        exit(NOT_UNDERSTOOD);
    }
}

int main(int count, char **arguments) {
    const fmi2CallbackFunctions callbacks = {log_message, allocate, release, NULL, NULL};
    char line[LONGEST_LINE];
    Host host = {0};
    if (count != 4) {
        fprintf(stderr, "usage: driver LIBRARY GUID RESOURCES < COMMANDS\n");
        return NOT_UNDERSTOOD;
    }
    if (!load_fmu_library(&host.fmu, arguments[1])) return NOT_UNDERSTOOD;
    host.instance = host.fmu.Instantiate("driver", fmi2CoSimulation, arguments[2], arguments[3],
                                         &callbacks, fmi2False, fmi2True);
    if (!host.instance) {
        fprintf(stderr, "fmi2Instantiate: no instance\n");
        return REFUSED;
    }
    set_up(&host);
    while (fgets(line, sizeof line, stdin)) {
        const char *command = strtok(line, " \r\n");
        if (command) obey(&host, command);
    }
    check(host.fmu.Terminate(host.instance), "fmi2Terminate");
    host.fmu.FreeInstance(host.instance);
    if (blocks_in_use) fprintf(stderr, "%lu blocks left behind\n", (unsigned long)blocks_in_use);
    return blocks_in_use ? REFUSED : 0;
}
