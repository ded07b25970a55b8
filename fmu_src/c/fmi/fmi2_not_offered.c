/* FMI 2.0: functions that this FMU does not offer, those of model exchange among them. Some hosts look up all functions
 * when they load an FMU, so they must exist. */
#include "fmi2_api.h"

/* The parameters are those that FMI prescribes; a refusal needs none but the instance. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define REFUSED(NAME, REASON, PARAMETERS) \
    fmi2Status fmi2##NAME PARAMETERS { \
        return report(c, STATUS_ERROR, "fmi2" #NAME " refused: " REASON); \
    }

REFUSED(CancelStep, "no step is ever pending", (fmi2Component c))
REFUSED(GetDirectionalDerivative, "there are none (providesDirectionalDerivative is false)",
        (fmi2Component c, const fmi2ValueReference vUnknown_ref[], size_t nUnknown,
         const fmi2ValueReference vKnown_ref[], size_t nKnown, const fmi2Real dvKnown[], fmi2Real dvUnknown[]))

#define MODEL_EXCHANGE "this FMU is for co-simulation"

REFUSED(EnterEventMode, MODEL_EXCHANGE, (fmi2Component c))
REFUSED(NewDiscreteStates, MODEL_EXCHANGE, (fmi2Component c, fmi2EventInfo *fmi2eventInfo))
REFUSED(EnterContinuousTimeMode, MODEL_EXCHANGE, (fmi2Component c))
REFUSED(CompletedIntegratorStep, MODEL_EXCHANGE,
        (fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint, fmi2Boolean *enterEventMode,
         fmi2Boolean *terminateSimulation))
REFUSED(SetTime, MODEL_EXCHANGE, (fmi2Component c, fmi2Real time))
REFUSED(SetContinuousStates, MODEL_EXCHANGE, (fmi2Component c, const fmi2Real x[], size_t nx))
REFUSED(GetDerivatives, MODEL_EXCHANGE, (fmi2Component c, fmi2Real derivatives[], size_t nx))
REFUSED(GetEventIndicators, MODEL_EXCHANGE, (fmi2Component c, fmi2Real eventIndicators[], size_t ni))
REFUSED(GetContinuousStates, MODEL_EXCHANGE, (fmi2Component c, fmi2Real x[], size_t nx))
REFUSED(GetNominalsOfContinuousStates, MODEL_EXCHANGE, (fmi2Component c, fmi2Real x_nominal[], size_t nx))
