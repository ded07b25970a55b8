/* FMI 2.0 for co-simulation: steps, their status, and functions that this FMU does not offer. */
#include "fmi2_api.h"

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
    fmi2Status status = answer(instance, done, &refusal);
    instance->last_step = (int)status;
    return status;
}

fmi2Status fmi2CancelStep(fmi2Component c) {
    return report(c, fmi2Error, "fmi2CancelStep refused: no step is ever pending");
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown, const fmi2ValueReference vKnown_ref[],
                                        size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
    (void)vUnknown_ref, (void)nUnknown, (void)vKnown_ref, (void)nKnown;
    (void)dvKnown, (void)dvUnknown;
    return report(c, fmi2Error,
                  "fmi2GetDirectionalDerivative refused: there are none "
                  "(providesDirectionalDerivative is false)");
}

/* Refuse a null pointer, and with fmi2Discard any status that is not `known`: FMI 2.0 demands fmi2Discard,
 * and it ends no run. */
static fmi2Status status_check(fmi2Component c, const void *value, bool known, const char *text) {
    if (c == NULL || value == NULL) {
        return report(c, fmi2Error,
                      "status refused: value is a null pointer; must point to memory");
    }
    return known ? fmi2OK : report(c, fmi2Discard, text);
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value) {
    fmi2Status checked = status_check(c, value, s == fmi2DoStepStatus,
                                      "fmi2GetStatus: the kind must be fmi2DoStepStatus");
    if (checked == fmi2OK) {
        *value = (fmi2Status)((const Instance *)c)->last_step;
    }
    return checked;
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value) {
    fmi2Status checked = status_check(c, value, s == fmi2LastSuccessfulTime,
                                      "fmi2GetRealStatus: the kind must be fmi2LastSuccessfulTime");
    if (checked == fmi2OK) {
        *value = ((const Instance *)c)->component.now.time;
    }
    return checked;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value) {
    (void)s;
    return status_check(c, value, false, "fmi2GetIntegerStatus: there is no such status");
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value) {
    fmi2Status checked = status_check(c, value, s == fmi2Terminated,
                                      "fmi2GetBooleanStatus: the kind must be fmi2Terminated");
    if (checked == fmi2OK) {
        *value = fmi2False;
    }
    return checked;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value) {
    (void)s;
    return status_check(c, value, false,
                        "fmi2GetStringStatus: there is no such status, no step is ever pending");
}
