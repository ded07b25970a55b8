"""Scenes with the FMU of FMI 3.0: what a host may do, and a device whose values change."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.checks.validate import validate
from slider_resonator.scenes.scene_files import find_scene

SCENES = ("interface", "table_1", "tuned", "burst", "tuned_lugre", "leap_tuned")


@pytest.mark.parametrize("name", SCENES)
def test_scene_passes(native_3_fmu: Path, name: str) -> None:
    (result,) = validate([native_3_fmu], [find_scene(name)])
    assert not result.run_failures
    failed = [(c.quantity, c.fmu, c.reference) for c in result.checks if not c.passed]
    assert not failed, "FMI 3.0 is another shell around the same component"
