/* FMI 3.0: functions that this FMU does not offer. Hosts look up all functions when they load an FMU, so they must
 * exist. */
#include "fmi3_api.h"

/* The parameters are those that FMI prescribes; a refusal needs none but the instance. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define MODEL_EXCHANGE "this FMU is for co-simulation"
#define BINARIES "there are no variables of type Binary"
#define CLOCKS "there are no clocks"
#define CONFIGURATION "there are no structural parameters"
#define DERIVATIVES "the model description promises none"
#define DEPENDENCIES "the model description lists them"
#define DISCRETE_STATES "there are none (providesEvaluateDiscreteStates is false)"

static fmi3Instance refuse_other_interface(const char *call, fmi3String name, fmi3InstanceEnvironment environment,
                                           fmi3LogMessageCallback logger) {
    Host host = fmi3_host(environment, logger);
    Refusal refusal;
    refuse(&refusal, "%s refused: %s", call, MODEL_EXCHANGE);
    return refuse_instance(&host, name, &refusal);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
    return refuse_other_interface("fmi3InstantiateModelExchange", instanceName, instanceEnvironment, logMessage);
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String instanceName, fmi3String instantiationToken,
                                               fmi3String resourcePath, fmi3Boolean visible, fmi3Boolean loggingOn,
                                               fmi3InstanceEnvironment instanceEnvironment,
                                               fmi3LogMessageCallback logMessage, fmi3ClockUpdateCallback clockUpdate,
                                               fmi3LockPreemptionCallback lockPreemption,
                                               fmi3UnlockPreemptionCallback unlockPreemption) {
    return refuse_other_interface("fmi3InstantiateScheduledExecution", instanceName, instanceEnvironment, logMessage);
}

#define REFUSED(NAME, REASON, PARAMETERS) \
    fmi3Status fmi3##NAME PARAMETERS { \
        return report(instance, STATUS_ERROR, "fmi3" #NAME " refused: " REASON); \
    }

/* The first parameters of functions of many variables. */
#define VARIABLES_OF fmi3Instance instance, const fmi3ValueReference valueReferences[], size_t nValueReferences
#define PRODUCT_OF \
    fmi3Instance instance, const fmi3ValueReference unknowns[], size_t nUnknowns, const fmi3ValueReference knowns[], \
        size_t nKnowns, const fmi3Float64 seed[], size_t nSeed

REFUSED(EnterContinuousTimeMode, MODEL_EXCHANGE, (fmi3Instance instance))
REFUSED(CompletedIntegratorStep, MODEL_EXCHANGE,
        (fmi3Instance instance, fmi3Boolean noSetFMUStatePriorToCurrentPoint, fmi3Boolean *enterEventMode,
         fmi3Boolean *terminateSimulation))
REFUSED(SetTime, MODEL_EXCHANGE, (fmi3Instance instance, fmi3Float64 time))
REFUSED(SetContinuousStates, MODEL_EXCHANGE,
        (fmi3Instance instance, const fmi3Float64 continuousStates[], size_t nContinuousStates))
REFUSED(GetContinuousStateDerivatives, MODEL_EXCHANGE,
        (fmi3Instance instance, fmi3Float64 derivatives[], size_t nContinuousStates))
REFUSED(GetEventIndicators, MODEL_EXCHANGE,
        (fmi3Instance instance, fmi3Float64 eventIndicators[], size_t nEventIndicators))
REFUSED(GetContinuousStates, MODEL_EXCHANGE,
        (fmi3Instance instance, fmi3Float64 continuousStates[], size_t nContinuousStates))
REFUSED(GetNominalsOfContinuousStates, MODEL_EXCHANGE,
        (fmi3Instance instance, fmi3Float64 nominals[], size_t nContinuousStates))
REFUSED(GetNumberOfEventIndicators, MODEL_EXCHANGE, (fmi3Instance instance, size_t *nEventIndicators))
REFUSED(GetNumberOfContinuousStates, MODEL_EXCHANGE, (fmi3Instance instance, size_t *nContinuousStates))
REFUSED(ActivateModelPartition, MODEL_EXCHANGE,
        (fmi3Instance instance, fmi3ValueReference clockReference, fmi3Float64 activationTime))

REFUSED(GetIntervalDecimal, CLOCKS, (VARIABLES_OF, fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[]))
REFUSED(GetIntervalFraction, CLOCKS,
        (VARIABLES_OF, fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[]))
REFUSED(GetShiftDecimal, CLOCKS, (VARIABLES_OF, fmi3Float64 shifts[]))
REFUSED(GetShiftFraction, CLOCKS, (VARIABLES_OF, fmi3UInt64 counters[], fmi3UInt64 resolutions[]))
REFUSED(SetIntervalDecimal, CLOCKS, (VARIABLES_OF, const fmi3Float64 intervals[]))
REFUSED(SetIntervalFraction, CLOCKS, (VARIABLES_OF, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]))
REFUSED(SetShiftDecimal, CLOCKS, (VARIABLES_OF, const fmi3Float64 shifts[]))
REFUSED(SetShiftFraction, CLOCKS, (VARIABLES_OF, const fmi3UInt64 counters[], const fmi3UInt64 resolutions[]))

REFUSED(GetBinary, BINARIES, (VARIABLES_OF, size_t valueSizes[], fmi3Binary values[], size_t nValues))
REFUSED(SetBinary, BINARIES, (VARIABLES_OF, const size_t valueSizes[], const fmi3Binary values[], size_t nValues))
REFUSED(GetClock, CLOCKS, (VARIABLES_OF, fmi3Clock values[]))
REFUSED(SetClock, CLOCKS, (VARIABLES_OF, const fmi3Clock values[]))

REFUSED(EnterConfigurationMode, CONFIGURATION, (fmi3Instance instance))
REFUSED(ExitConfigurationMode, CONFIGURATION, (fmi3Instance instance))

REFUSED(GetOutputDerivatives, DERIVATIVES,
        (VARIABLES_OF, const fmi3Int32 orders[], fmi3Float64 values[], size_t nValues))
REFUSED(GetDirectionalDerivative, DERIVATIVES, (PRODUCT_OF, fmi3Float64 sensitivity[], size_t nSensitivity))
REFUSED(GetAdjointDerivative, DERIVATIVES, (PRODUCT_OF, fmi3Float64 sensitivity[], size_t nSensitivity))

REFUSED(GetNumberOfVariableDependencies, DEPENDENCIES,
        (fmi3Instance instance, fmi3ValueReference valueReference, size_t *nDependencies))
REFUSED(GetVariableDependencies, DEPENDENCIES,
        (fmi3Instance instance, fmi3ValueReference dependent, size_t elementIndicesOfDependent[],
         fmi3ValueReference independents[], size_t elementIndicesOfIndependents[], fmi3DependencyKind dependencyKinds[],
         size_t nDependencies))

REFUSED(EvaluateDiscreteStates, DISCRETE_STATES, (fmi3Instance instance))
