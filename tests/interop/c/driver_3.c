/* A host of FMI 3.0 in C: `driver_3 LIBRARY TOKEN FRICTION_LAW FIDELITY REFERENCES...`.
 *
 * Runs table 1 for 40 steps of 1 ms in event mode and prints the values of the references
 * after each step, then the number of events. References: friction_law, fidelity, those to print. */
#include <stdlib.h>

#include "fmi3Functions.h"
#include "fmu_library.h"

enum { MAX_OUTPUTS = 32, STEPS = 40 };
static const double STEP = 1e-3;

static void *library;

typedef void (*Function)(void);

static Function function(const char *name) {
    Function address;
    (void)load_fmu_library; /* that of FMI 2.0 */
    if (!find_function(library, name, &address, sizeof address)) exit(2);
    return address;
}

static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                        fmi3String message) {
    (void)environment;
    fprintf(stderr, "%d %s %s\n", (int)status, category, message);
}

static void check(fmi3Status status, const char *call) {
    if (status != fmi3OK) {
        fprintf(stderr, "%s: status %d\n", call, (int)status);
        exit(1);
    }
}

#define CALL(name, ...) check(((fmi3##name##TYPE *)function("fmi3" #name))(__VA_ARGS__), #name)

/* Leaves event mode, in which there is nothing to do. */
static void leave_event_mode(fmi3Instance slider) {
    fmi3Boolean update, terminate, nominals, states, defined;
    fmi3Float64 next;
    CALL(UpdateDiscreteStates, slider, &update, &terminate, &nominals, &states, &defined, &next);
    CALL(EnterStepMode, slider);
}

int main(int count, char **arguments) {
    fmi3ValueReference references[MAX_OUTPUTS];
    double values[MAX_OUTPUTS];
    size_t outputs = 0;
    if (count < 7 || (library = open_library(arguments[1])) == NULL) return 2;
    fmi3Int32 choices[] = {atoi(arguments[3]), atoi(arguments[4])};
    fmi3ValueReference chosen[] = {(fmi3ValueReference)atoi(arguments[5]),
                                   (fmi3ValueReference)atoi(arguments[6])};
    for (int i = 7; i < count && outputs < MAX_OUTPUTS; i++) {
        references[outputs++] = (fmi3ValueReference)atoi(arguments[i]);
    }
    fmi3InstantiateCoSimulationTYPE *instantiate =
        (fmi3InstantiateCoSimulationTYPE *)function("fmi3InstantiateCoSimulation");
    fmi3Instance slider = instantiate("slider", arguments[2], NULL, false, true, true, true, NULL, 0,
                                      NULL, log_message, NULL);
    if (slider == NULL) {
        return 1;
    }
    CALL(SetInt32, slider, chosen, 2, choices, 2);
    CALL(EnterInitializationMode, slider, false, 0.0, 0.0, false, 0.0);
    CALL(ExitInitializationMode, slider);
    leave_event_mode(slider);
    double time = 0.0;
    int events = 0;
    for (int index = 1; index <= STEPS; index++) {
        while (time < index * STEP) {
            fmi3Boolean event, terminate, early;
            double reached;
            CALL(DoStep, slider, time, index * STEP - time, true, &event, &terminate, &early,
                 &reached);
            time = early ? reached : index * STEP;
            if (event) {
                events++;
                CALL(EnterEventMode, slider);
                leave_event_mode(slider);
            }
        }
        CALL(GetFloat64, slider, references, outputs, values, outputs);
        for (size_t i = 0; i < outputs; i++) {
            printf("%.17g ", values[i]);
        }
        printf("\n");
    }
    printf("%d\n", events);
    CALL(Terminate, slider);
    ((fmi3FreeInstanceTYPE *)function("fmi3FreeInstance"))(slider);
    return 0;
}
