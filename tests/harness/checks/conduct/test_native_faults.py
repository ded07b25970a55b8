"""Faults in the life of an instance are noticed by the scenes that are made for them."""

from __future__ import annotations

from pathlib import Path

import pytest

from fmu_src.building.c_sources import slider_sources
from slider_resonator.checks.validate import validate
from slider_resonator.scenes.scene_files import find_scene
from tests.harness.native_faults import FAULTS, build_faulty

SCENES = sorted({scene for *_, scene in FAULTS.values()})


@pytest.mark.slow
@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_is_noticed(tmp_path: Path, name: str) -> None:
    scene = FAULTS[name][-1]
    (validation,) = validate([build_faulty(name, tmp_path)], [find_scene(scene)], time_limit=60.0)
    assert validation.exit_code == 1, (validation.run_failures, "it must be a check that fails")


@pytest.mark.parametrize("name", FAULTS)
def test_a_fault_changes_one_place(name: str) -> None:
    file, old, new, _ = FAULTS[name]
    assert slider_sources()[file].count(old) == 1
    assert old != new
