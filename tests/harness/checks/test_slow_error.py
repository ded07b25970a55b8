"""The error that averages make over the one that they report, on a run that is known."""

from __future__ import annotations

import math

import pytest

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measuring import WITHIN, error_over_estimate
from slider_resonator.checks.natural_scale import fast_velocity
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
quantity = "error_over_estimate"
at_most = 1.0
why = "test"
"""


def test_the_error_is_taken_over_the_estimate_at_the_same_point(instance: Instance) -> None:
    side = FmuSide(instance, scene_of(AVERAGED))
    side.record["mean_velocity"][:] = side.resolved["mean_velocity"]
    assert error_over_estimate(side) == 0.0
    side.record["slow_motion_error"][:] = 1e-3
    side.record["mean_velocity"][2:4] += (1e-3, 1e-4)
    side.record["slow_motion_error"][3] = 5e-5
    assert error_over_estimate(side) == pytest.approx(2.0, rel=1e-6)
    side.record["slow_motion_error"][3] = 0.0
    assert error_over_estimate(side) == math.inf


def test_errors_far_below_the_tolerance_count_as_none(instance: Instance) -> None:
    side = FmuSide(instance, scene_of(AVERAGED))
    device = side.scene.device
    least = WITHIN * device.tolerance * fast_velocity(device)
    side.record["slow_motion_error"][:] = 0.0
    for share, expected in ((0.9, 0.0), (1.1, math.inf)):
        side.record["mean_velocity"][:] = side.resolved["mean_velocity"] + share * least
        assert error_over_estimate(side) == expected


def test_the_start_is_left_out(instance: Instance) -> None:
    side = FmuSide(instance, scene_of(AVERAGED))
    before = error_over_estimate(side)
    side.record["mean_velocity"][0] += 1e3
    assert error_over_estimate(side) == before


def test_resolved_runs_are_to_a_tolerance_of_their_own(instance: Instance) -> None:
    bristles = AVERAGED.replace("fidelity = 0", "fidelity = 2\nfriction_law = 1\ntolerance = {}")
    sides = [FmuSide(instance, scene_of(bristles.format(at))) for at in (1e-4, 1e-10)]
    exact = list(sides[1].record["mean_velocity"])
    assert [list(side.resolved["mean_velocity"]) for side in sides] == [exact, exact]
    assert list(sides[0].record["mean_velocity"]) != exact


def test_an_fmu_without_estimate_has_no_share(
    instance: Instance, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delitem(instance.fmu.variables, "slow_motion_error")
    with pytest.raises(NotApplicable):
        error_over_estimate(FmuSide(instance, scene_of(AVERAGED)))
