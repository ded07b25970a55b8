"""Leaps over periods: their error against resolved motion, where they hold, what they predict."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import pytest

from fmu_src.python.slider_component.component import motion_of
from fmu_src.python.slider_component.device import Device
from fmu_src.python.slider_component.moment import Moment
from fmu_src.python.slider_component.parameters import Inputs
from fmu_src.python.slider_component.period_map import PeriodMap
from fmu_src.python.slider_component.prediction import prediction
from fmu_src.python.slider_component.values import Refusal

PERIOD = math.tau / 3500.0
FAST_VELOCITY = 0.2366097
SLOW = Device(fidelity=0)


def pair(device: Device, inputs: Inputs, periods: int, steps: int = 1) -> tuple[Moment, Moment]:
    ends = []
    for fidelity in (0, 2):
        motion = motion_of(replace(device, fidelity=fidelity), inputs)
        now = motion.start()
        for _ in range(steps):
            now = motion.advance(now, periods * PERIOD / steps)
        ends.append(now)
    return ends[0], ends[1]


@pytest.mark.parametrize(
    ("parameters", "inputs"),
    [
        ({}, Inputs()),
        ({}, Inputs(0.7, 0.03)),
        ({}, Inputs(0.4, 0.0, 3.0)),
        ({}, Inputs(0.0, 0.0, 1.0001)),
        ({}, Inputs(0.0, 0.5)),
        ({"normal_amplitude": 1.8}, Inputs(0.4)),
        ({"normal_amplitude": 1.8}, Inputs(0.4, 0.0, 1.5)),
        ({"damping_ratio": 1.2}, Inputs(0.4)),
        ({"resonator_frequency": 9000.0, "damping_ratio": 0.02}, Inputs(0.4)),
        ({"resonator_mass": 0.0, "tangential_force": 900.0}, Inputs(1.0)),
        ({"friction_coefficient": 1.0}, Inputs()),
        ({"normal_amplitude": 0.0}, Inputs()),
        ({"initial_velocity": 0.5}, Inputs(0.3)),
    ],
)
def test_leaps_err_by_their_tolerance(parameters: dict[str, Any], inputs: Inputs) -> None:
    device = replace(SLOW, **parameters)
    leapt, resolved = pair(device, inputs, 1500)
    error = abs(leapt.mean_velocity - resolved.mean_velocity)
    assert error <= 10.0 * device.tolerance * FAST_VELOCITY
    assert error <= 3.0 * leapt.leap_error + 1e-9 * FAST_VELOCITY, "the error is measured"
    assert leapt.position == pytest.approx(resolved.position, abs=1500 * PERIOD * 3e-8)
    assert leapt.theta == pytest.approx(resolved.theta, abs=1e-9)
    for name in ("displacement", "rate"):
        peak = 1.3e-3 if name == "displacement" else 4.0
        assert getattr(leapt, name) == pytest.approx(getattr(resolved, name), abs=1e-6 * peak)
    if not parameters and inputs.load < 0.2:
        assert leapt.leap_error > 0.0, "it leaps"
        assert leapt.reversals == resolved.reversals


@pytest.mark.parametrize("stiffness", [1e4, 1e7])
def test_leaps_with_bristles(stiffness: float) -> None:
    device = replace(SLOW, friction_law=1, bristle_stiffness=stiffness)
    leapt, resolved = pair(device, Inputs(), 300)
    assert leapt.leap_error > 0.0
    assert leapt.mean_velocity == pytest.approx(resolved.mean_velocity, abs=3e-8)


def test_the_error_follows_the_tolerance() -> None:
    errors = []
    for tolerance in (1e-5, 1e-7, 1e-9):
        leapt, resolved = pair(replace(SLOW, tolerance=tolerance), Inputs(), 1500)
        errors.append(abs(leapt.mean_velocity - resolved.mean_velocity))
        assert errors[-1] <= tolerance * FAST_VELOCITY
    assert errors[0] > errors[1] > errors[2]


def test_a_long_step_takes_few_maps(monkeypatch: pytest.MonkeyPatch) -> None:
    maps = []
    sections = PeriodMap.sections

    def counted(self: PeriodMap, now: Moment, count: int, budget: Any) -> Any:
        maps.append(count)
        return sections(self, now, count, budget)

    monkeypatch.setattr(PeriodMap, "sections", counted)
    motion = motion_of(SLOW, Inputs())
    motion.advance(motion.start(), 20_000 * PERIOD)
    assert sum(maps) <= 1500


def test_steps_too_short_to_gain_are_resolved_motion() -> None:
    leapt, resolved = pair(SLOW, Inputs(), 600, steps=20)
    assert replace(leapt, leap_error=0.0) == resolved
    assert leapt.leap_error == 0.0


MEASURED = [
    (Inputs(), 0.12666699702, 0.08518613221),
    (Inputs(0.4, 0.05), 0.0986950617, None),
    (Inputs(0.4, 0.0, 3.0), -0.0362968157, None),
]
"""Fixed points found by shooting with other programs."""


@pytest.mark.parametrize(("inputs", "velocity", "force"), MEASURED)
def test_predictions_are_fixed_points(inputs: Inputs, velocity: float, force: float | None) -> None:
    found = prediction(Device(), inputs, 0.0)
    assert found.valid
    assert found.steady_velocity == pytest.approx(velocity, abs=6e-11)
    if force is not None:
        assert found.blocking_force == pytest.approx(force, abs=6e-11)


def test_a_predicted_load_blocks() -> None:
    force = prediction(Device(), Inputs(0.4), 0.0).blocking_force
    blocked = prediction(Device(), Inputs(0.4, force), 0.0)
    assert blocked.steady_velocity == pytest.approx(0.0, abs=1e-10)


@pytest.mark.parametrize("ratio", [1.0 / 3.0, 0.5, 1.5, 1.2])
def test_predictions_are_where_motion_settles(ratio: float) -> None:
    device = replace(SLOW, friction_coefficient=1.0, normal_amplitude=1.5)
    found = prediction(device, Inputs(0.4, 0.0, ratio), 0.0)
    motion = motion_of(device, Inputs(0.4, 0.0, ratio))
    now = motion.advance(motion.start(), 6000 * PERIOD)
    position, turns = now.position, 30
    now = motion.advance(now, turns * PERIOD)
    mean = (now.position - position) / (turns * PERIOD)
    assert found.valid
    assert mean == pytest.approx(found.steady_velocity, abs=3e-8)


def test_ratios_that_never_repeat_have_no_prediction() -> None:
    assert not prediction(Device(), Inputs(0.0, 0.0, math.sqrt(2.0)), 0.0).valid


def test_undamped_resonance_is_resolved() -> None:
    """No steady vibration exists, so that nothing can be leapt over."""
    mass = 0.0999999999999
    free = 3500.0 * math.sqrt(1.0 / (1.0 + mass))
    device = replace(SLOW, damping_ratio=0.0, resonator_mass=mass, resonator_frequency=free)
    with pytest.raises(Refusal):
        motion_of(replace(device, averaging_order=1), Inputs())
    leapt, resolved = pair(device, Inputs(0.4), 200)
    assert leapt == resolved
