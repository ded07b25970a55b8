"""The component: damaged snapshots, rounded time, and what outputs read before a step."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import pytest

from fmu_src.python.slider_component.component import Component
from fmu_src.python.slider_component.outputs import OUTPUTS
from fmu_src.python.slider_component.refusal import Refusal


def running(start_time: float = 0.0, **values: float) -> Component:
    component = Component()
    component.setup_experiment(start_time, None)
    component.enter_initialization()
    component.set(values)
    component.exit_initialization()
    return component


def one(component: Component, name: str) -> float:
    return component.get(name)[0]


def outputs(component: Component) -> dict[str, float]:
    return dict(zip(OUTPUTS, component.get(*OUTPUTS), strict=True))


@pytest.mark.parametrize(
    "damage",
    [
        lambda before: {"format": "something else"},
        lambda before: {**before, "time": math.nan},
        lambda before: {**before, "values": {"phase": 0.0}},
        lambda before: {**before, "moment": {**before["moment"], "psi": "x"}},
        lambda before: {**before, "moment": None},
    ],
)
def test_a_snapshot_that_is_none_changes_nothing(
    damage: Callable[[dict[str, Any]], dict[str, Any]],
) -> None:
    """Bytes of the FMU get that far only with a matching checksum."""
    component = running()
    component.step(0.0, 0.01)
    before = component.snapshot()
    with pytest.raises(Refusal, match="refused"):
        component.restore(damage(before))
    assert component.snapshot() == before


def test_hosts_may_round_their_time() -> None:
    component, time = running(), 0.0
    for _ in range(10_000):
        component.step(time, 1e-4 / 3.0)
        time += 1e-4 / 3.0
    assert component.time == time


def test_outputs_before_the_first_step() -> None:
    component = Component()
    with pytest.raises(Refusal, match="reading position refused in state 'instantiated'"):
        one(component, "position")
    component.enter_initialization()
    component.set({"initial_velocity": 0.3, "phase": math.pi / 2})
    assert one(component, "velocity") == one(component, "mean_velocity") == 0.3
    assert one(component, "normal_force") == 2.0
    assert one(component, "contact_mode") == 1.0
    assert one(component, "stick_fraction") == 0.0


@pytest.mark.parametrize("phase", [0.3, -2.0, 3.0])
def test_whole_turns_of_phase_change_nothing(phase: float) -> None:
    far = phase + 1e12 * math.tau
    near = running(phase=math.remainder(far, math.tau))
    turned = running(phase=far)
    near.step(0.0, 0.01)
    turned.step(0.0, 0.01)
    assert outputs(turned) == outputs(near)
    assert one(turned, "phase") == far
