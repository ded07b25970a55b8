"""Faults in calls, states and event mode of an FMU of FMI 3.0 are rejected."""

from pathlib import Path

import pytest

from slider_resonator.scenes.scene_files import find_scene
from studies.mutants.bench import Judging
from studies.mutants.changes import Change
from studies.mutants.runs import run_changes

CALLS, VALUES = "fmi/fmi3.c", "fmi/value_access.c"
FOUND = "if (now->event_age == 0.0 && found_at(search, &clock)) {"
TIME = "is_time(references[i]) ? instance->component.now.time : *next++;"
GIVEN = "return value_count == count"
EXPERIMENT = "stopTimeDefined ? stopTime : INFINITY"

FAULTS: dict[str, tuple[str, str, str]] = {
    "the step is said to reach its end": (
        CALLS,
        "*lastSuccessfulTime = component->now.time;",
        "*lastSuccessfulTime = end;",
    ),
    "an event at the end of a step is an early return": (
        CALLS,
        "*earlyReturn = event && component->now.time < end;",
        "*earlyReturn = event;",
    ),
    "no event needs handling": (
        CALLS,
        "*eventHandlingNeeded = event;",
        "*eventHandlingNeeded = fmi3False;",
    ),
    "an event ends the simulation": (
        CALLS,
        "    *terminateSimulation = fmi3False;\n    *earlyReturn",
        "    *terminateSimulation = event;\n    *earlyReturn",
    ),
    "a step returns early though it must not": (
        CALLS,
        "if (own->event_mode_used && own->early_return_allowed) {",
        "if (own->event_mode_used) {",
    ),
    "event mode is entered though it is not used": (
        CALLS,
        "if (instance != NULL && !instance->event_mode_used) {",
        "if (false) {",
    ),
    "an event at 0 s is announced for ever": (
        CALLS,
        "        *nextEventTimeDefined = fmi3False;",
        "        *nextEventTimeDefined = fmi3True;",
    ),
    "time stands still between events": (VALUES, TIME, TIME.replace("now.time", "now.stop_time")),
    "values after time are off by one": (VALUES, TIME, TIME.replace("*next++", "found[i]")),
    "time can be set": (VALUES, "if (done && place_count < count) {", "if (false) {"),
    "too many values are accepted": (VALUES, GIVEN, GIVEN.replace("==", ">=")),
    "initialization does not end in event mode": (
        CALLS,
        "if (done && own->event_mode_used) {",
        "if (false) {",
    ),
    "the stop time is ignored": (
        CALLS,
        EXPERIMENT,
        EXPERIMENT.replace("stopTimeDefined", "fmi3False"),
    ),
    "a lift-off is no event": (
        "resolved/events.c",
        FOUND,
        FOUND.replace("&&", "&& now->mode != LIFTED &&"),
    ),
    "a release is no event": (
        "resolved/events.c",
        FOUND,
        FOUND.replace("&&", "&& !leg_released(&leg) &&"),
    ),
    "an event at the end of a step is lost": (
        "resolved/events.c",
        "            end_at_event(&leg, law, now);\n",
        "",
    ),
}
"""Of event mode: what is wrong, the C file and what to replace by what."""

OTHER_FAULTS: dict[str, tuple[str, str, str, str]] = {
    "a bad experiment is accepted": (
        "refusal_faults",
        CALLS,
        "component_setup_experiment(&own->component, &experiment, &refusal)",
        "(component_setup_experiment(&own->component, &experiment, &refusal) || true)",
    ),
    "initialisation mode ends where it has not begun": (
        "refusal_faults",
        "component/component.c",
        'if (!require("exitInitializationMode", component->now.lifecycle, INITIALIZATION, refusal)'
        "\n        || !prepare",
        "if (!prepare",
    ),
    "values outside their bounds are taken": (
        "refusal_faults",
        "component/values.c",
        "    return value_check(variable, value, refusal);\n}\n\nvoid start",
        "    return isfinite(value) || value_check(variable, value, refusal);\n}\n\nvoid start",
    ),
    "a state is not got into the place of another": (
        "state_faults",
        "fmi/state_access.c",
        "    memcpy(*state, snapshot, sizeof *snapshot);\n    return true;",
        "    if (((const Snapshot *)*state)->time == 0.0) {\n"
        "        memcpy(*state, snapshot, sizeof *snapshot);\n    }\n    return true;",
    ),
    "a damaged state is taken": (
        "state_faults",
        "component/state_bytes.c",
        "get_bits(bytes + checked) == checksum(bytes, checked)",
        "true",
    ),
    "the pointer to a state that is freed stays": (
        "state_faults",
        "fmi/state_access.c",
        "        *state = NULL;\n",
        "",
    ),
}
"""Of others: the quantity that notices it comes first."""


@pytest.mark.isolated
@pytest.mark.slow
def test_faults_of_fmi_3_are_rejected(native_3_fmu: Path) -> None:
    faults = FAULTS | {name: change[1:] for name, change in OTHER_FAULTS.items()}
    changes = [
        Change(f"fault_{i}", *change, meaning) for i, (meaning, change) in enumerate(faults.items())
    ]
    run = run_changes(native_3_fmu, changes, Judging([find_scene("interface")]))
    assert [verdict.variant.meaning for verdict in run.survivors] == []
    found = {verdict.variant.meaning: verdict.quantity for verdict in run.verdicts}
    assert {name: found[name] for name in OTHER_FAULTS} == {
        name: quantity for name, (quantity, *_) in OTHER_FAULTS.items()
    }
