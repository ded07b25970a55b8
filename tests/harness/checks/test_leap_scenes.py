"""Scenes of leaps: order 2 meets them, order 1 does not."""

from __future__ import annotations

from pathlib import Path

import pytest

from slider_resonator.checks.validate import Validation, validate
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.scene_files import find_scene

OF_BOTH = {"normal_force", "contact_mode", "prediction_valid", "error_over_estimate"}
"""Quantities that do not depend on the order, or whose bound each order keeps."""


def judged(fmu: Path, scene: Scene) -> Validation:
    (result,) = validate([fmu], [scene])
    assert not result.run_failures
    return result


def of_order_1(name: str) -> Scene:
    scene = find_scene(name)
    assert scene.device.averaging_order == 2
    return scene.with_values({"averaging_order": 1})


@pytest.mark.slow
@pytest.mark.parametrize("scene", ["leap_table_1", "leap_strong_friction"])
def test_the_order_decides(native_fmu: Path, scene: str) -> None:
    second = judged(native_fmu, find_scene(scene))
    assert not [check.quantity for check in second.checks if not check.passed]
    first = judged(native_fmu, of_order_1(scene))
    passed = {check.quantity for check in first.checks if check.passed}
    assert passed <= OF_BOTH


def test_predictions_of_order_1_are_not_exact(native_fmu: Path) -> None:
    scene = of_order_1("resolved_no_slow_error")
    failed = {check.quantity for check in judged(native_fmu, scene).checks if not check.passed}
    assert failed == {"final_predicted_velocity", "final_predicted_blocking_force"}
