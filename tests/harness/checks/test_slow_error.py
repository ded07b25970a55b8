"""The error that averages make over the one that they report, on a run that is known."""

from __future__ import annotations

import math
from collections.abc import Callable

import pytest

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measures.slow_error import (
    mean_error_share,
    momentary_error_share,
    slow_error_share,
)
from slider_resonator.errors import NotApplicable
from slider_resonator.fmu.instance import Instance
from tests.harness.scene_text import scene_of

AVERAGED = """
[device]
fidelity = 0
averaging_order = 1

[run]
drive_periods = 10
steps_per_period = 2

[[expect]]
quantity = "mean_error_share"
at_most = 1.0
why = "test"
"""


def test_the_shares_are_those_of_the_largest_error_and_estimate(instance: Instance) -> None:
    side = FmuSide(instance, scene_of(AVERAGED))
    made, exact = side.record, side.resolved
    estimate = max(made["slow_motion_error"])
    means = [abs(a - b) for a, b in zip(made["mean_velocity"], exact["mean_velocity"], strict=True)]
    assert mean_error_share(side) == pytest.approx(max(means[1:]) / estimate, rel=1e-12)
    r = side.scene.device.mass_ratio
    velocities = zip(made["velocity"], exact["velocity"], strict=True)
    swings = zip(made["resonator_velocity"], exact["resonator_velocity"], strict=True)
    moments = [abs(a - b + r * (c - d)) for (a, b), (c, d) in zip(velocities, swings, strict=True)]
    assert slow_error_share(side) == pytest.approx(max(moments[1:]) / estimate, rel=1e-9)


def test_the_momentary_share_is_that_of_an_error_and_the_estimate_then(instance: Instance) -> None:
    side = FmuSide(instance, scene_of(AVERAGED))
    side.record["mean_velocity"][:] = side.resolved["mean_velocity"]
    assert momentary_error_share(side) == 0.0
    side.record["slow_motion_error"][:] = 1e-3
    side.record["mean_velocity"][2:4] += (1e-3, 1e-4)
    side.record["slow_motion_error"][3] = 5e-5
    assert momentary_error_share(side) == pytest.approx(2.0, rel=1e-6)
    side.record["slow_motion_error"][3] = 0.0
    assert momentary_error_share(side) == math.inf


@pytest.mark.parametrize("measure", [mean_error_share, momentary_error_share])
def test_the_start_is_left_out(instance: Instance, measure: Callable[[FmuSide], float]) -> None:
    side = FmuSide(instance, scene_of(AVERAGED))
    before = measure(side)
    side.record["mean_velocity"][0] += 1e3
    assert measure(side) == before


def test_resolved_runs_differ_only_in_fidelity(instance: Instance) -> None:
    side = FmuSide(instance, scene_of(AVERAGED.replace("fidelity = 0", "fidelity = 2")))
    assert list(side.record["velocity"]) == list(side.resolved["velocity"])


@pytest.mark.parametrize("measure", [mean_error_share, momentary_error_share, slow_error_share])
def test_an_fmu_without_estimate_has_no_share(
    instance: Instance, monkeypatch: pytest.MonkeyPatch, measure: Callable[[FmuSide], float]
) -> None:
    monkeypatch.delitem(instance.fmu.variables, "slow_motion_error")
    with pytest.raises(NotApplicable):
        measure(FmuSide(instance, scene_of(AVERAGED)))
