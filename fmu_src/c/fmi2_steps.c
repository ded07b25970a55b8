/* FMI 2.0 for co-simulation: steps, their status, and functions that this FMU does not offer. */
#include "instance.h"

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint,
                      fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
    (void)noSetFMUStatePriorToCurrentPoint;
    Instance *instance = c;
    Refusal refusal;
    if (instance == NULL) {
        return fmi2Error;
    }
    bool done = component_step(&instance->component, currentCommunicationPoint,
                               communicationStepSize, &refusal);
    instance->last_step = answer(instance, done, &refusal);
    return instance->last_step;
}

fmi2Status fmi2CancelStep(fmi2Component c) {
    return not_offered(c, "fmi2CancelStep refused: no step is ever pending");
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    (void)vr, (void)nvr, (void)order, (void)value;
    return not_offered(c, "fmi2SetRealInputDerivatives refused: inputs are held over a step "
                       "(canInterpolateInputs is false)");
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
    (void)vr, (void)nvr, (void)order, (void)value;
    return not_offered(c, "fmi2GetRealOutputDerivatives refused: there are none "
                       "(maxOutputDerivativeOrder is 0)");
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown, const fmi2ValueReference vKnown_ref[],
                                        size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
    (void)vUnknown_ref, (void)nUnknown, (void)vKnown_ref, (void)nKnown;
    (void)dvKnown, (void)dvUnknown;
    return not_offered(c, "fmi2GetDirectionalDerivative refused: there are none "
                       "(providesDirectionalDerivative is false)");
}

/* FMI 2.0 demands fmi2Discard for an unknown status; no run ends because of it. */
static fmi2Status unknown_status(fmi2Component c, const char *text) {
    return c == NULL ? fmi2Error : report(c, fmi2Discard, text);
}

static fmi2Status refuse_null_status(fmi2Component c) {
    return not_offered(c, "status refused: value is a null pointer; must point to memory");
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value) {
    if (c == NULL || value == NULL) {
        return refuse_null_status(c);
    }
    if (s != fmi2DoStepStatus) {
        return unknown_status(c, "fmi2GetStatus: the kind must be fmi2DoStepStatus");
    }
    *value = ((const Instance *)c)->last_step;
    return fmi2OK;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value) {
    if (c == NULL || value == NULL) {
        return refuse_null_status(c);
    }
    if (s != fmi2LastSuccessfulTime) {
        return unknown_status(c, "fmi2GetRealStatus: the kind must be fmi2LastSuccessfulTime");
    }
    *value = ((const Instance *)c)->component.now.time;
    return fmi2OK;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value) {
    (void)s;
    if (c == NULL || value == NULL) {
        return refuse_null_status(c);
    }
    return unknown_status(c, "fmi2GetIntegerStatus: there is no such status");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value) {
    if (c == NULL || value == NULL) {
        return refuse_null_status(c);
    }
    if (s != fmi2Terminated) {
        return unknown_status(c, "fmi2GetBooleanStatus: the kind must be fmi2Terminated");
    }
    *value = fmi2False;
    return fmi2OK;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value) {
    (void)s;
    if (c == NULL || value == NULL) {
        return refuse_null_status(c);
    }
    return unknown_status(c, "fmi2GetStringStatus: there is no such status, no step is ever pending");
}
