/* FMI 3.0: functions that this FMU does not offer. Hosts look up all functions when they load an FMU,
 * so they must exist. */
#include <stddef.h>

#include "fmi3_api.h"

#define MODEL_EXCHANGE "this FMU is for co-simulation"
#define CLOCKS "there are no clocks"
#define CONFIGURATION "there are no structural parameters"
#define DERIVATIVES "the model description promises none"
#define DEPENDENCIES "the model description lists them"
#define DISCRETE_STATES "there are none (providesEvaluateDiscreteStates is false)"

fmi3Status not_offered(fmi3Instance instance, const char *call, const char *reason) {
    Refusal refusal;
    refuse(&refusal, "%s refused: %s", call, reason);
    return answer(instance, false, &refusal);
}

static fmi3Instance refuse_other_interface(const char *call, fmi3String name,
                                           fmi3InstanceEnvironment environment,
                                           fmi3LogMessageCallback logger) {
    Host host = fmi3_host(environment, logger);
    Refusal refusal;
    refuse(&refusal, "%s refused: %s", call, MODEL_EXCHANGE);
    return refuse_instance(&host, name, &refusal);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible,
                                          fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
    (void)instantiationToken, (void)resourcePath, (void)visible, (void)loggingOn;
    return refuse_other_interface("fmi3InstantiateModelExchange", instanceName,
                                  instanceEnvironment, logMessage);
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
    fmi3Boolean visible, fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage, fmi3ClockUpdateCallback clockUpdate,
    fmi3LockPreemptionCallback lockPreemption, fmi3UnlockPreemptionCallback unlockPreemption) {
    (void)instantiationToken, (void)resourcePath, (void)visible, (void)loggingOn;
    (void)clockUpdate, (void)lockPreemption, (void)unlockPreemption;
    return refuse_other_interface("fmi3InstantiateScheduledExecution", instanceName,
                                  instanceEnvironment, logMessage);
}

fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance instance) {
    return not_offered(instance, "fmi3EnterContinuousTimeMode", MODEL_EXCHANGE);
}

fmi3Status fmi3CompletedIntegratorStep(fmi3Instance instance,
                                       fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                                       fmi3Boolean *enterEventMode,
                                       fmi3Boolean *terminateSimulation) {
    (void)noSetFMUStatePriorToCurrentPoint, (void)enterEventMode, (void)terminateSimulation;
    return not_offered(instance, "fmi3CompletedIntegratorStep", MODEL_EXCHANGE);
}

fmi3Status fmi3SetTime(fmi3Instance instance, fmi3Float64 time) {
    (void)time;
    return not_offered(instance, "fmi3SetTime", MODEL_EXCHANGE);
}

fmi3Status fmi3SetContinuousStates(fmi3Instance instance, const fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
    (void)continuousStates, (void)nContinuousStates;
    return not_offered(instance, "fmi3SetContinuousStates", MODEL_EXCHANGE);
}

fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance instance, fmi3Float64 derivatives[],
                                             size_t nContinuousStates) {
    (void)derivatives, (void)nContinuousStates;
    return not_offered(instance, "fmi3GetContinuousStateDerivatives", MODEL_EXCHANGE);
}

fmi3Status fmi3GetEventIndicators(fmi3Instance instance, fmi3Float64 eventIndicators[],
                                  size_t nEventIndicators) {
    (void)eventIndicators, (void)nEventIndicators;
    return not_offered(instance, "fmi3GetEventIndicators", MODEL_EXCHANGE);
}

fmi3Status fmi3GetContinuousStates(fmi3Instance instance, fmi3Float64 continuousStates[],
                                   size_t nContinuousStates) {
    (void)continuousStates, (void)nContinuousStates;
    return not_offered(instance, "fmi3GetContinuousStates", MODEL_EXCHANGE);
}

fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance instance, fmi3Float64 nominals[],
                                             size_t nContinuousStates) {
    (void)nominals, (void)nContinuousStates;
    return not_offered(instance, "fmi3GetNominalsOfContinuousStates", MODEL_EXCHANGE);
}

fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance instance, size_t *nEventIndicators) {
    (void)nEventIndicators;
    return not_offered(instance, "fmi3GetNumberOfEventIndicators", MODEL_EXCHANGE);
}

fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance instance, size_t *nContinuousStates) {
    (void)nContinuousStates;
    return not_offered(instance, "fmi3GetNumberOfContinuousStates", MODEL_EXCHANGE);
}

fmi3Status fmi3ActivateModelPartition(fmi3Instance instance, fmi3ValueReference clockReference,
                                      fmi3Float64 activationTime) {
    (void)clockReference, (void)activationTime;
    return not_offered(instance, "fmi3ActivateModelPartition", MODEL_EXCHANGE);
}

fmi3Status fmi3GetIntervalDecimal(fmi3Instance instance,
                                  const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, fmi3Float64 intervals[],
                                  fmi3IntervalQualifier qualifiers[]) {
    (void)valueReferences, (void)nValueReferences, (void)intervals, (void)qualifiers;
    return not_offered(instance, "fmi3GetIntervalDecimal", CLOCKS);
}

fmi3Status fmi3GetIntervalFraction(fmi3Instance instance,
                                   const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, fmi3UInt64 counters[],
                                   fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    (void)qualifiers;
    return not_offered(instance, "fmi3GetIntervalFraction", CLOCKS);
}

fmi3Status fmi3GetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, fmi3Float64 shifts[]) {
    (void)valueReferences, (void)nValueReferences, (void)shifts;
    return not_offered(instance, "fmi3GetShiftDecimal", CLOCKS);
}

fmi3Status fmi3GetShiftFraction(fmi3Instance instance,
                                const fmi3ValueReference valueReferences[],
                                size_t nValueReferences, fmi3UInt64 counters[],
                                fmi3UInt64 resolutions[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    return not_offered(instance, "fmi3GetShiftFraction", CLOCKS);
}

fmi3Status fmi3SetIntervalDecimal(fmi3Instance instance,
                                  const fmi3ValueReference valueReferences[],
                                  size_t nValueReferences, const fmi3Float64 intervals[]) {
    (void)valueReferences, (void)nValueReferences, (void)intervals;
    return not_offered(instance, "fmi3SetIntervalDecimal", CLOCKS);
}

fmi3Status fmi3SetIntervalFraction(fmi3Instance instance,
                                   const fmi3ValueReference valueReferences[],
                                   size_t nValueReferences, const fmi3UInt64 counters[],
                                   const fmi3UInt64 resolutions[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    return not_offered(instance, "fmi3SetIntervalFraction", CLOCKS);
}

fmi3Status fmi3SetShiftDecimal(fmi3Instance instance, const fmi3ValueReference valueReferences[],
                               size_t nValueReferences, const fmi3Float64 shifts[]) {
    (void)valueReferences, (void)nValueReferences, (void)shifts;
    return not_offered(instance, "fmi3SetShiftDecimal", CLOCKS);
}

fmi3Status fmi3SetShiftFraction(fmi3Instance instance,
                                const fmi3ValueReference valueReferences[],
                                size_t nValueReferences, const fmi3UInt64 counters[],
                                const fmi3UInt64 resolutions[]) {
    (void)valueReferences, (void)nValueReferences, (void)counters, (void)resolutions;
    return not_offered(instance, "fmi3SetShiftFraction", CLOCKS);
}

fmi3Status fmi3EnterConfigurationMode(fmi3Instance instance) {
    return not_offered(instance, "fmi3EnterConfigurationMode", CONFIGURATION);
}

fmi3Status fmi3ExitConfigurationMode(fmi3Instance instance) {
    return not_offered(instance, "fmi3ExitConfigurationMode", CONFIGURATION);
}

fmi3Status fmi3GetOutputDerivatives(fmi3Instance instance,
                                    const fmi3ValueReference valueReferences[],
                                    size_t nValueReferences, const fmi3Int32 orders[],
                                    fmi3Float64 values[], size_t nValues) {
    (void)valueReferences, (void)nValueReferences, (void)orders, (void)values, (void)nValues;
    return not_offered(instance, "fmi3GetOutputDerivatives", DERIVATIVES);
}

fmi3Status fmi3GetDirectionalDerivative(fmi3Instance instance,
                                        const fmi3ValueReference unknowns[], size_t nUnknowns,
                                        const fmi3ValueReference knowns[], size_t nKnowns,
                                        const fmi3Float64 seed[], size_t nSeed,
                                        fmi3Float64 sensitivity[], size_t nSensitivity) {
    (void)unknowns, (void)nUnknowns, (void)knowns, (void)nKnowns, (void)seed, (void)nSeed;
    (void)sensitivity, (void)nSensitivity;
    return not_offered(instance, "fmi3GetDirectionalDerivative", DERIVATIVES);
}

fmi3Status fmi3GetAdjointDerivative(fmi3Instance instance, const fmi3ValueReference unknowns[],
                                    size_t nUnknowns, const fmi3ValueReference knowns[],
                                    size_t nKnowns, const fmi3Float64 seed[], size_t nSeed,
                                    fmi3Float64 sensitivity[], size_t nSensitivity) {
    (void)unknowns, (void)nUnknowns, (void)knowns, (void)nKnowns, (void)seed, (void)nSeed;
    (void)sensitivity, (void)nSensitivity;
    return not_offered(instance, "fmi3GetAdjointDerivative", DERIVATIVES);
}

fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance instance,
                                               fmi3ValueReference valueReference,
                                               size_t *nDependencies) {
    (void)valueReference, (void)nDependencies;
    return not_offered(instance, "fmi3GetNumberOfVariableDependencies", DEPENDENCIES);
}

fmi3Status fmi3GetVariableDependencies(fmi3Instance instance, fmi3ValueReference dependent,
                                       size_t elementIndicesOfDependent[],
                                       fmi3ValueReference independents[],
                                       size_t elementIndicesOfIndependents[],
                                       fmi3DependencyKind dependencyKinds[], size_t nDependencies) {
    (void)dependent, (void)elementIndicesOfDependent, (void)independents;
    (void)elementIndicesOfIndependents, (void)dependencyKinds, (void)nDependencies;
    return not_offered(instance, "fmi3GetVariableDependencies", DEPENDENCIES);
}

fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance instance) {
    return not_offered(instance, "fmi3EvaluateDiscreteStates", DISCRETE_STATES);
}
