"""Verdicts, on stand-ins for the FMU so that every kind of wrong result can be made."""

from collections.abc import Mapping
from contextlib import nullcontext
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest

from slider_resonator.checks.compare import Check, Comparison, compare
from slider_resonator.checks.expecting import expected_value
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measures import Tube
from slider_resonator.checks.measuring import measure
from slider_resonator.checks.natural_scale import smallest_reference
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.checks.verdict import sentence
from slider_resonator.device.device import Device
from slider_resonator.errors import SceneError
from slider_resonator.scenes.scene import ScenePoint, scene_from
from slider_resonator.scenes.schema import ExpectTable

TABLE_1 = {"name": "scene", "title": "Scene"}
STILL = {**TABLE_1, "device": {"base_amplitude": 0.0}}
"""A device without a natural scale of velocities and displacements."""
WAVE = np.sin(np.linspace(0.0, 50.0, 1000))


def fmu(**parts: Any) -> FmuSide:
    scene = SimpleNamespace(name="scene", source="scene.toml", start_time=0.0, drive_period=0.5)
    instance = SimpleNamespace(explained=nullcontext)
    return cast(FmuSide, SimpleNamespace(scene=scene, instance=instance, **parts))


def steady(velocity: float | None) -> FmuSide:
    """Steady motion found in 37 periods; what is None has a reason."""
    motion = SimpleNamespace(
        steady_velocity=velocity, status="steady", periods=37, reason="because"
    )
    return fmu(steady=motion)


def reference(**parts: Any) -> ReferenceSide:
    side = SimpleNamespace(scene=fmu().scene, **parts)
    side.by = lambda _: side
    return cast(ReferenceSide, side)


def judge(
    fmu_side: FmuSide,
    reference_side: ReferenceSide | None = None,
    content: Mapping[str, Any] = STILL,
    **expect: Any,
) -> Check:
    table = ExpectTable.model_validate({"why": "test", **expect})
    sides = measure(table.quantity, fmu_side), expected_value(table, reference_side or reference())
    return compare(Comparison.of(table), *sides, ScenePoint(scene_from(content, "scene.toml")))


class RecordOf(dict[str, np.ndarray]):
    """Outputs by name at 1000 points, 1 ms apart."""

    times = 1e-3 * np.arange(1000)


def judge_signal(signal: np.ndarray, expected: np.ndarray, **expect: Any) -> Check:
    table = {"quantity": "position", "reference": "located_events", "relative": 1e-8, **expect}
    record = RecordOf({table["quantity"]: signal})
    return judge(fmu(record=record), reference(signal=lambda output: expected), **table)


@pytest.mark.parametrize(
    ("velocity", "expect", "passed"),
    [
        (np.nextafter(0.0, 1.0), {"value": 0.0, "absolute": 0.0}, True),
        (1e-15, {"value": 0.0, "absolute": 0.0}, False),
        (np.nextafter(0.1, 1.0), {"value": 0.1, "absolute": 0.0}, True),
        (0.1 + 1e-15, {"value": 0.1, "absolute": 0.0}, False),
        (np.nan, {"value": 0.1, "relative": 1e9}, False),
        (np.inf, {"value": 0.1, "relative": 1e9}, False),
        (None, {"value": 0.1, "relative": 1e9}, False),
        (np.nan, {"at_most": 37}, False),
        (np.nan, {"at_least": 37}, False),
        (0.1, {"quantity": "steady_status", "value": "steady"}, True),
        (0.1, {"quantity": "steady_status", "value": "stuck"}, False),
        (0.1, {"quantity": "steady_periods", "at_most": 37}, True),
        (0.1, {"quantity": "steady_periods", "at_most": 36}, False),
        (0.1, {"quantity": "steady_periods", "at_least": 37}, True),
        (0.1, {"quantity": "steady_periods", "at_least": 38}, False),
    ],
)
def test_numbers_and_words(velocity: float | None, expect: dict[str, Any], passed: bool) -> None:
    verdict = judge(steady(velocity), **{"quantity": "steady_velocity", **expect})
    assert verdict.passed is passed
    if expect.get("relative") == 1e9:
        assert verdict.severity == float("inf"), "a value that is none is beyond all"
    assert verdict.note == ("because" if velocity is None else "")


ZERO, TINY = 0.0 * WAVE, 1e-17 * WAVE
NEAR = {"absolute": 1e-12}
NO_SCALE = {"quantity": "resonator_displacement"}


@pytest.mark.parametrize(
    ("signal", "expected", "expect", "passed"),
    [
        (WAVE, WAVE, {}, True),
        (WAVE * (1.0 + 5e-9), WAVE, {}, True),
        (WAVE * (1.0 + 5e-8), WAVE, {}, False),
        (-WAVE, WAVE, {}, False),
        (np.roll(WAVE, 1), WAVE, {}, False),
        (np.where(np.arange(1000) == 500, np.nan, WAVE), WAVE, {}, False),
        # Near a reference of zero the absolute tolerance counts.
        (ZERO + 9e-13, ZERO, NEAR, True),
        (ZERO + 2e-12, ZERO, NEAR, False),
        (TINY + 9e-13, TINY, NEAR, True),
        (TINY + 2e-12, TINY, NEAR, False),
        # Zero without a scale may be the rounding of a usual value.
        (5e-19 * WAVE, ZERO, NO_SCALE, True),
        (2e-18 * WAVE, ZERO, NO_SCALE, False),
    ],
)
def test_a_signal_is_judged_by_its_largest_deviation(
    signal: np.ndarray, expected: np.ndarray, expect: dict[str, Any], passed: bool
) -> None:
    verdict = judge_signal(signal, expected, **expect)
    assert verdict.passed is passed
    assert verdict.allowed == 1e-8 or expected is not WAVE
    if expect is NEAR:
        assert verdict.deviation is not None
        assert verdict.deviation < np.inf, "a share of next to nothing means nothing"


def test_a_failed_signal_says_from_where_on_and_where_most() -> None:
    signal = WAVE.copy()
    signal[300] += 1e-6
    signal[700] += 1e-3
    verdict = judge_signal(signal, WAVE)
    assert (verdict.first_time, verdict.worst_time) == pytest.approx((0.3, 0.7))
    assert (verdict.fmu_then, verdict.reference_then) == (signal[700], WAVE[700])
    assert judge_signal(WAVE, WAVE).first_time is None
    lost = np.where(np.arange(1000) >= 500, np.nan, WAVE)
    assert judge_signal(lost, WAVE).first_time == 0.5


def test_a_signal_without_oscillation_fails_and_one_too_short_could_not_run() -> None:
    expect: dict[str, Any] = {"quantity": "ripple_frequency", "value": 557.0, "relative": 1e-6}
    for still in (np.ones(1000), np.full(1000, np.nan)):
        verdict = judge(fmu(record=RecordOf(velocity=still)), **expect)
        assert not verdict.passed
        assert "ripple_frequency does not exist" in verdict.note
    short = RecordOf(velocity=WAVE[:10])
    short.times = RecordOf.times[:10]
    with pytest.raises(SceneError, match=r"ripple_frequency cannot be measured: .* 16 points"):
        judge(fmu(record=short), **expect)


@pytest.mark.parametrize(("share", "passed"), [(9e-7, True), (2e-6, False)])
def test_reference_near_zero_is_a_share_of_its_natural_scale(share: float, passed: bool) -> None:
    smallest = smallest_reference("steady_velocity", Device())
    velocity = share * smallest
    expect: dict[str, Any] = {"quantity": "steady_velocity", "value": 1e-17, "relative": 1e-6}
    verdict = judge(steady(velocity), content=TABLE_1, **expect)
    assert verdict.passed is passed
    assert verdict.allowed == pytest.approx(1e-6 * smallest)
    assert not judge(steady(velocity), **expect).passed
    assert not judge(steady(velocity), content=TABLE_1, **expect, absolute=0.0).passed, (
        "the scene has the last word"
    )
    large = judge(steady(0.1), content=TABLE_1, **{**expect, "value": 0.1})
    assert large.allowed == pytest.approx(1e-7), "the natural scale loosens nothing else"


def test_inside_a_tube_a_signal_may_be_late_but_no_larger() -> None:
    tube = Tube(WAVE, np.minimum(np.roll(WAVE, 1), WAVE), np.maximum(np.roll(WAVE, 1), WAVE))
    requested = []

    def around(output: str, share: float) -> Tube:
        requested.append((output, share))
        return tube

    def judged(signal: np.ndarray) -> Check:
        return judge(
            fmu(record=RecordOf(position=signal)),
            reference(tube=around),
            quantity="position",
            reference="located_events",
            relative=1e-8,
            tube=0.01,
        )

    assert judged(np.roll(WAVE, 1)).passed
    assert requested == [("position", 0.01)]
    late = judged(np.roll(WAVE, 2))
    assert not late.passed
    assert "outside a tube of 0.01 drive periods to each side by" in sentence(late)
    assert not judged(-WAVE).passed


@pytest.mark.parametrize(("shift", "passed"), [(9e-4, True), (2e-3, False), (np.nan, False)])
def test_events_may_be_off_by_a_share_of_the_period(shift: float, passed: bool) -> None:
    events = np.floor(np.linspace(0.0, 20.0, 1000))
    found = events.copy()
    found[600:620] += shift
    side = fmu(record=RecordOf(last_event_time=0.5 * found))
    verdict = judge(
        side,
        reference(in_run=lambda measure: Tube(events, events, events)),
        quantity="event_times",
        reference="located_events",
        tube=1e-3,
    )
    assert verdict.passed is passed
    assert verdict.allowed == 1e-3
    if not passed:
        assert verdict.first_time == 0.6
    if shift == 2e-3:
        message = "off by 0.002 drive periods, 2 times the allowed 0.001; from 0.6 s on"
        assert sentence(verdict).startswith(message)
