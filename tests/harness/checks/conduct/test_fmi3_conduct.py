"""Refusals and states of an FMU of FMI 3.0 are tried, too."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.scenes.scene_files import find_scene
from studies.mutants.bench import Judging
from studies.mutants.changes import Change
from studies.mutants.runs import run_changes

FAULTS = {
    "a bad experiment is accepted": (
        "refusal_faults",
        "fmi/fmi3.c",
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
"""What is wrong: the quantity that notices it, the C file and what to replace by what."""


@pytest.mark.isolated
@pytest.mark.slow
def test_faults_in_refusals_and_states_are_rejected(native_3_fmu: Path) -> None:
    changes = [
        Change(f"fault_{i}", file, old, new, meaning)
        for i, (meaning, (_, file, old, new)) in enumerate(FAULTS.items())
    ]
    run = run_changes(native_3_fmu, changes, Judging([find_scene("interface")]))
    found = {verdict.variant.meaning: verdict.quantity for verdict in run.verdicts}
    assert found == {meaning: quantity for meaning, (quantity, *_) in FAULTS.items()}
