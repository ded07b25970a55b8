"""Scenes of averaged motion: the FMU meets the averaged reference, and nothing else does."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.checks.validate import validate
from tests.harness.scene_text import read_scene

SCENE = """
name = "scene"
title = "Averaged motion expected of another device"
[device]
fidelity = {fidelity}
averaging_order = 1
friction_law = 1
bristle_stiffness = 2e4
[inputs]
phase = 0.4
[run]
drive_periods = 40
steps_per_period = 8
[[expect]]
quantity = "{quantity}"
reference = "averaged"
relative = {relative}
why = "it is averaged motion that is expected"
"""


@pytest.mark.parametrize(
    ("fidelity", "quantity", "relative", "passes"),
    [
        (0, "position", 1e-6, True),
        (0, "velocity", 1e-6, True),
        (2, "position", 1e-3, False),
        (2, "velocity", 1e-3, False),
        (2, "slow_displacement", 0.05, True),
        (2, "slow_displacement", 1e-4, False),
    ],
)
def test_resolved_motion_is_near_and_only_averaged_motion_is_equal(
    native_fmu: Path, tmp_path: Path, fidelity: int, quantity: str, relative: float, passes: bool
) -> None:
    scene = tmp_path / "scene.toml"
    scene.write_text(SCENE.format(fidelity=fidelity, quantity=quantity, relative=relative))
    ((check,),) = (v.checks for v in validate([native_fmu], [read_scene(scene)]))
    assert check.passed is passes, f"off by {check.deviation}"
