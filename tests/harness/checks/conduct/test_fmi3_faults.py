"""Faults in calls, states and event mode of an FMU of FMI 3.0 are rejected."""

import tomllib
from pathlib import Path

import pytest

from slider_resonator.scenes.scene_files import find_scene
from studies.mutants.bench import Judging
from studies.mutants.changes import Change
from studies.mutants.runs import run_changes

FAULTS = tomllib.loads(Path(__file__).with_name("fmi3_faults.toml").read_text(encoding="utf-8"))


@pytest.mark.isolated
@pytest.mark.slow
def test_faults_of_fmi_3_are_rejected(native_3_fmu: Path) -> None:
    changes, noticed = [], {}
    for file, entries in FAULTS.items():
        for name, entry in entries.items():
            changes.append(Change(name, file, entry["old"], entry["new"], entry["what"]))
            if "quantity" in entry:
                noticed[name] = entry["quantity"]
    run = run_changes(native_3_fmu, changes, Judging([find_scene("interface")]))
    assert [verdict.variant.meaning for verdict in run.survivors] == []
    found = {verdict.variant.name: verdict.quantity for verdict in run.verdicts}
    assert {name: found[name] for name in noticed} == noticed
