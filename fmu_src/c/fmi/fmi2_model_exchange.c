/* FMI 2.0 for model exchange, which this FMU refuses. Some hosts look up all functions when they load
 * an FMU, so they must exist. */
#include "fmi2_api.h"

/* The parameters are those that FMI prescribes; a refusal needs none but the instance. */
#pragma GCC diagnostic ignored "-Wunused-parameter"

#define REFUSED(NAME, PARAMETERS) \
    fmi2Status fmi2##NAME PARAMETERS { \
        return report(c, fmi2Error, "fmi2" #NAME " refused: this FMU is for co-simulation"); \
    }

REFUSED(EnterEventMode, (fmi2Component c))
REFUSED(NewDiscreteStates, (fmi2Component c, fmi2EventInfo *fmi2eventInfo))
REFUSED(EnterContinuousTimeMode, (fmi2Component c))
REFUSED(CompletedIntegratorStep,
        (fmi2Component c, fmi2Boolean noSetFMUStatePriorToCurrentPoint,
         fmi2Boolean *enterEventMode, fmi2Boolean *terminateSimulation))
REFUSED(SetTime, (fmi2Component c, fmi2Real time))
REFUSED(SetContinuousStates, (fmi2Component c, const fmi2Real x[], size_t nx))
REFUSED(GetDerivatives, (fmi2Component c, fmi2Real derivatives[], size_t nx))
REFUSED(GetEventIndicators, (fmi2Component c, fmi2Real eventIndicators[], size_t ni))
REFUSED(GetContinuousStates, (fmi2Component c, fmi2Real x[], size_t nx))
REFUSED(GetNominalsOfContinuousStates, (fmi2Component c, fmi2Real x_nominal[], size_t nx))
