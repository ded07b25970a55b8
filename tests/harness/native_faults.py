"""Faults of the life of an instance, each a small change of the C sources."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from fmu_src.building.c_sources import slider_sources
from fmu_src.building.native_fmu import build_native
from fmu_src.building.platforms import HOST

_PREPARED = "    component->prepared = running;\n"
_CHECKED = "    if (isfinite(value) && value >= variable->minimum && value <= variable->maximum"

FAULTS: Mapping[str, tuple[str, str, str, str]] = {
    "a tuned value acts only after the next start": (
        "component/component.c",
        "    component->present = next;\n",
        "    component->present = component->now.lifecycle == STEP_COMPLETE ? 1 - next : next;\n",
        "tuned",
    ),
    "another drive frequency restarts the drive": (
        "component/component.c",
        _PREPARED,
        _PREPARED + "    const double was = component->now.values[VR_DRIVE_FREQUENCY];\n"
        "    if (changed[VR_DRIVE_FREQUENCY] != was) component->now.moment.theta = 0.0;\n",
        "tuned",
    ),
    "a turn of two frequencies lasts as long as one of the last": (
        "device/period.c",
        "        double length = means->elapsed + last;",
        "        double length = TAU / frequency;",
        "tuned",
    ),
    "contact mode is that of the last step": (
        "component/outputs.c",
        "        return law->motion->mode(law, moment);\n    case VR_REVERSALS:",
        "        return moment->mode;\n    case VR_REVERSALS:",
        "read_at_rest",
    ),
    "events are timed from the start": (
        "component/component.c",
        "component->now.time = component->now.last_event_time = experiment->start_time;",
        "component->now.time = experiment->start_time;",
        "late_start",
    ),
    "tiny steps do not move": (
        "component/component.c",
        "duration = step_size - owed;",
        "duration = step_size < 1e-8 ? 0.0 : step_size - owed;",
        "late_start",
    ),
    "instances share a count": (
        "component/component.c",
        "    now->moment = *after;\n",
        "    static double total;\n"
        "    double reversals = after->counts.reversals;\n"
        "    total += reversals - now->moment.counts.reversals;\n"
        "    now->moment = *after;\n"
        "    now->moment.counts.reversals = total = reversals == 0.0 ? 0.0 : total;\n",
        "tuned",
    ),
    "a value set back to its start is ignored": (
        "component/component.c",
        "values[i] == component->now.values[references[i]];",
        "values[i] == VARIABLES[references[i]].start;",
        "tuned",
    ),
    "predictions are kept when the load is set alone": (
        "component/component.c",
        "inputs.phase, inputs.load);\n    component->theory.known = false;",
        "inputs.phase, inputs.load);",
        "predictions_at_once",
    ),
    "the last successful time is that of the start": (
        "fmi/fmi2_steps.c",
        "*value = ((const Instance *)c)->component.now.time;",
        "*value = 0.0;",
        "tuned",
    ),
    "a serialised state lacks the bristle": (
        "component/snapshot.c",
        "    FIELD(moment.bristle, FINITE, 0, 0),\n",
        "",
        "tuned_lugre",
    ),
    "a restored state keeps the present law": (
        "component/component.c",
        "    if (snapshot->moving && !prepare(",
        "    if (snapshot->moving && !component->prepared && !prepare(",
        "tuned_fidelity_1",
    ),
    "infinity is accepted": (
        "component/values.c",
        _CHECKED,
        _CHECKED.replace("isfinite(value)", "isinf(value) || (value == value") + ")",
        "interface",
    ),
    "another start of the bristle stiffness": (
        "component/variables.c",
        '"bristle_stiffness", false, true, 100000.0',
        '"bristle_stiffness", false, true, 10000.0',
        "interface",
    ),
    "a step of zero is accepted": (
        "component/experiment.c",
        "step_size > 0.0)",
        "step_size >= 0.0)",
        "interface",
    ),
    "a description of another build is served": (
        "fmi/instance.c",
        "if (token == NULL || strcmp(token, MODEL_GUID) != 0) {",
        "if (token == NULL) {",
        "interface",
    ),
    "a damaged state is taken": (
        "component/state_bytes.c",
        "    return get_bits(bytes + checked) == checksum(bytes, checked)\n           ||",
        "    return true\n           ||",
        "interface",
    ),
    "a state got again is the old one": (
        "fmi/state_access.c",
        "    if (*state == NULL) {\n        *state = host_allocate",
        "    if (*state != NULL) {\n        return true;\n    }\n"
        "    {\n        *state = host_allocate",
        "interface",
    ),
    "the last step of a sum of steps is refused": (
        "component/experiment.c",
        "if (time + step_size > stop_time + slack + STOP_TIME_SLACK * fabs(stop_time)) {",
        "if (time + step_size > stop_time) {",
        "interface",
    ),
    "bristles without friction are accepted": (
        "friction/lugre.c",
        "    return device->friction_coefficient != 0.0 ||\n",
        "    return device->friction_coefficient >= 0.0 ||\n",
        "interface",
    ),
    "an input set anew goes on growing": (
        "component/component.c",
        "    hold_inputs(component->now.derivatives, references, count);\n    return true;",
        "    return true;",
        "ramps_conduct",
    ),
    "bristles go on with the old drive": (
        "friction/bending_kernels.c",
        "plant->drive_frequency, plant->slip.eigenvalue};",
        "0.0, plant->slip.eigenvalue};",
        "tuned_lugre_stiff",
    ),
    "a falling ratio does not chirp": (
        "friction/taylor_slide.c",
        "        if (chirp != 0.0) {\n",
        "        if (chirp > 0.0) {\n",
        "chirp_falling",
    ),
    "switching logs is refused": (
        "fmi/instance.c",
        "    return known;\n}\n\nStatus",
        "    return false;\n}\n\nStatus",
        "interface",
    ),
    "a mean velocity that is held has a derivative": (
        "resolved/resolved_motion.c",
        "return (Rates){rates, 0.0};",
        "return (Rates){rates, rates.velocity};",
        "late_start",
    ),
    "derivatives of inputs outlive a reset": (
        "component/component.c",
        "    memset(&component->now, 0, sizeof component->now);\n",
        "    InputDerivative kept[VARYING_COUNT];\n"
        "    memcpy(kept, component->now.derivatives, sizeof kept);\n"
        "    memset(&component->now, 0, sizeof component->now);\n"
        "    memcpy(component->now.derivatives, kept, sizeof kept);\n",
        "ramps_conduct",
    ),
    "outputs read in initialization mode are 0": (
        "component/component.c",
        "    if (!component->now.moving) {\n        *first",
        "    if (component->now.lifecycle == INSTANTIATED) {\n        *first",
        "interface",
    ),
    "a state saved early keeps the law of later values": (
        "component/component.c",
        "component->prepared = snapshot->moving;",
        "component->prepared = true;",
        "interface",
    ),
    "a call for no values is refused": (
        "fmi/fmi2_values.c",
        "if (count > 0 && (references == NULL || values == NULL)) {",
        "if (references == NULL || values == NULL) {",
        "interface",
    ),
    "bristles hold a slider at rest": (
        "resolved/resolved_motion.c",
        "mode != STICK || is_elastic(&law->bristle)",
        "mode != STICK",
        "tuned_lugre",
    ),
}
"""What is wrong: the C file, what to replace by what, and the scene that must notice."""


def build_faulty(name: str, folder: Path) -> Path:
    """Build the native FMU for this platform with one fault."""
    file, old, new, _ = FAULTS[name]
    code = dict(slider_sources())
    assert code[file].count(old) == 1, f"{file} has changed: {old!r}"
    code[file] = code[file].replace(old, new)
    return build_native(folder, platforms=[HOST], code=code)
