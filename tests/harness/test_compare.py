"""Verdicts, on stand-ins for the FMU so that every kind of wrong result can be made."""

from __future__ import annotations

from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from harness.compare import Check, check
from harness.errors import SceneError
from harness.fmu_side import FmuSide
from harness.reference_side import ReferenceSide
from harness.scene_model import ExpectTable

WAVE = np.sin(np.linspace(0.0, 50.0, 1000))


def fmu(**parts: Any) -> FmuSide:
    scene = SimpleNamespace(name="scene", source="scene.toml")
    return cast(FmuSide, SimpleNamespace(scene=scene, **parts))


def steady(velocity: float | None, status: str = "steady") -> FmuSide:
    motion = SimpleNamespace(steady_velocity=velocity, status=status, periods=37, reason="because")
    return fmu(steady=motion)


def reference(**parts: Any) -> ReferenceSide:
    return cast(ReferenceSide, SimpleNamespace(**parts))


def judge(fmu_side: FmuSide, reference_side: ReferenceSide | None = None, **expect: Any) -> Check:
    table = ExpectTable.model_validate({"why": "test", **expect})
    return check(table, fmu_side, reference_side or reference(), {})


@pytest.mark.parametrize(("velocity", "passed"), [(0.1 + 9e-9, True), (0.1 + 2e-7, False)])
def test_a_number_may_deviate_by_the_relative_tolerance(velocity: float, passed: bool) -> None:
    verdict = judge(steady(velocity), quantity="steady_velocity", value=0.1, relative=1e-6)
    assert verdict.passed is passed
    assert verdict.allowed == pytest.approx(1e-7)
    assert verdict.deviation == pytest.approx(velocity - 0.1, rel=1e-6)


def test_with_a_tolerance_of_0_only_equality_passes() -> None:
    expect = {"quantity": "steady_velocity", "value": 0.0, "absolute": 0.0}
    assert judge(steady(0.0), **expect).passed
    assert not judge(steady(1e-300), **expect).passed


@pytest.mark.parametrize("velocity", [float("nan"), float("inf"), None])
def test_what_is_no_number_fails(velocity: float | None) -> None:
    verdict = judge(steady(velocity), quantity="steady_velocity", value=0.1, relative=1e9)
    assert not verdict.passed
    assert verdict.severity == float("inf")


def test_a_missing_result_carries_its_reason() -> None:
    verdict = judge(steady(None), quantity="steady_velocity", value=0.1, relative=1e-6)
    assert verdict.note == "because"


def test_a_reference_without_a_result_fails() -> None:
    side = reference(steady_velocity=None)
    expect = {"quantity": "steady_velocity", "reference": "located_events", "relative": 1.0}
    assert not judge(steady(0.1), side, **expect).passed


def test_words_must_be_equal() -> None:
    stuck = steady(0.0, "stuck")
    assert judge(stuck, quantity="steady_status", value="stuck").passed
    assert not judge(stuck, quantity="steady_status", value="steady").passed


def test_bounds_are_one_sided() -> None:
    assert judge(steady(0.1), quantity="steady_periods", at_most=37).passed
    assert not judge(steady(0.1), quantity="steady_periods", at_most=36).passed
    assert judge(steady(0.1), quantity="steady_periods", at_least=37).passed
    assert not judge(steady(0.1), quantity="steady_periods", at_least=38).passed


@pytest.mark.parametrize(
    ("signal", "passed"),
    [
        (WAVE, True),
        (WAVE * (1.0 + 5e-9), True),
        (WAVE * (1.0 + 5e-8), False),
        (-WAVE, False),
        (np.roll(WAVE, 1), False),
        (np.where(np.arange(1000) == 500, np.nan, WAVE), False),
    ],
)
def test_a_signal_is_judged_by_its_largest_deviation(signal: np.ndarray, passed: bool) -> None:
    side = reference(signal=lambda referee, name: WAVE)
    verdict = judge(
        fmu(record={"position": signal}),
        side,
        quantity="position",
        reference="located_events",
        relative=1e-8,
    )
    assert verdict.passed is passed
    assert verdict.allowed == 1e-8


def test_a_comparison_that_makes_no_sense_could_not_run() -> None:
    class Refusing:
        @property
        def averaged_velocity(self) -> float:
            raise ValueError("frequency_ratio = 3.0: the closed form allows only 1")

    with pytest.raises(SceneError, match=r"scene.toml: steady_velocity cannot be compared"):
        judge(
            steady(0.1),
            cast(ReferenceSide, Refusing()),
            quantity="steady_velocity",
            reference="closed_form",
            relative=1e-6,
        )
