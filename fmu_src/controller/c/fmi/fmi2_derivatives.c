/* FMI 2.0 for co-simulation: derivatives of inputs and outputs, which this FMU does not offer. */
#include "fmi2_api.h"

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    (void)vr, (void)nvr, (void)order, (void)value;
    return report(c, fmi2Error,
                  "fmi2SetRealInputDerivatives refused: inputs are held over a step "
                  "(canInterpolateInputs is false)");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
    (void)vr, (void)nvr, (void)order, (void)value;
    return report(c, fmi2Error,
                  "fmi2GetRealOutputDerivatives refused: there are none "
                  "(maxOutputDerivativeOrder is 0)");
}
