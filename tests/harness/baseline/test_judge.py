"""Comparing results with recorded ones."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
import pytest

from slider_resonator.baseline.judge import compare_golden
from slider_resonator.checks.compare import Check
from slider_resonator.checks.measuring import Measurement
from slider_resonator.checks.verdict import sentence
from slider_resonator.errors import SceneError
from slider_resonator.scenes.scene import ScenePoint
from slider_resonator.scenes.scene_files import find_scene

TIMES = np.linspace(0.0, 0.1, 48)
WAVE = 1e-3 * np.sin(500.0 * TIMES)


@pytest.fixture(scope="module")
def point() -> ScenePoint:
    return ScenePoint(find_scene("table_1"))


def judged(point: ScenePoint, name: str, golden: Any, now: Any, tolerance: float = 1e-8) -> Check:
    def measured(value: Any) -> Mapping[str, Measurement]:
        times = TIMES[: len(value)] if isinstance(value, np.ndarray) else None
        return {name: Measurement(value, times=times)}

    ((check, _),) = compare_golden(point, measured(golden), measured(now), tolerance)
    return check


@pytest.mark.parametrize(
    ("name", "golden", "now", "passed"),
    [
        ("steady_velocity", 0.1, 0.1 * (1 + 9e-9), True),
        ("steady_velocity", 0.1, 0.1 * (1 + 2e-8), False),
        ("steady_velocity", 0.0, 1e-12, True),
        ("steady_velocity", 0.0, 1e-9, False),
        ("steady_velocity", None, None, True),
        ("steady_velocity", 0.1, None, False),
        ("steady_velocity", None, 0.1, False),
        ("steady_status", "steady", "steady", True),
        ("steady_status", "steady", "unstable", False),
        ("reversals", 199.0, 199.0, True),
        ("reversals", 199.0, 200.0, False),
        ("position", WAVE, WAVE * (1 + 9e-9), True),
        ("position", WAVE, WAVE * (1 + 2e-8), False),
        ("position", WAVE, np.roll(WAVE, 1), False),
        ("contact_mode", np.sign(WAVE), np.sign(WAVE), True),
        ("contact_mode", np.sign(WAVE), -np.sign(WAVE), False),
        ("event_times", 557.0 * TIMES, 557.0 * TIMES + 9e-9, True),
        ("event_times", 557.0 * TIMES, 557.0 * TIMES + 2e-8, False),
    ],
)
def test_changes_above_the_tolerance_are_reported(
    point: ScenePoint, name: str, golden: Any, now: Any, passed: bool
) -> None:
    verdict = judged(point, name, golden, now)
    assert verdict.passed is passed, sentence(verdict)
    assert verdict.against == "baseline"


def test_a_change_is_reported_with_size_and_place(point: ScenePoint) -> None:
    now = WAVE.copy()
    now[20:] += 1e-6
    verdict = judged(point, "position", WAVE, now)
    assert verdict.first_time == TIMES[20]
    assert sentence(verdict).startswith("off by 0.001 of the peak")


def test_other_points_are_no_change_but_another_run(point: ScenePoint) -> None:
    with pytest.raises(SceneError, match="has other points"):
        judged(point, "position", WAVE, WAVE[:20])


def test_new_and_missing_quantities_are_changes(point: ScenePoint) -> None:
    golden = {"reversals": Measurement(199.0)}
    ((new, _),) = compare_golden(point, {}, golden, 1e-8)
    ((gone, _),) = compare_golden(point, golden, {}, 1e-8)
    assert not new.passed
    assert not gone.passed
    assert "no longer allows it" in sentence(gone)
