from __future__ import annotations

from math import pi

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.interface import INPUT_STARTS
from slider_resonator.fmu.instance import Instance
from slider_resonator.steady.periodic import (
    Facts,
    FmuPeriodMap,
    Obstacle,
    read_facts,
    repeating_periods,
)


def facts(**values: float) -> Facts:
    return Facts({**vars(Device()), **INPUT_STARTS, **values}, 0.0, 0.0, None)


@pytest.mark.parametrize("amplitude", [0.0, 0.5, 1.0, 1.5, 4.0])
def test_mean_normal_force_is_that_of_the_clipped_sine(amplitude: float) -> None:
    angle = (np.arange(200_000) + 0.5) / 200_000 * 2.0 * pi
    mean = np.maximum(0.0, 1.0 + amplitude * np.sin(angle)).mean()
    assert facts(normal_amplitude=amplitude).mean_normal_force == pytest.approx(mean, rel=1e-9)


def test_normal_force_at_ratio_0_is_constant() -> None:
    still = facts(frequency_ratio=0.0, phase=-pi / 6.0)
    assert still.mean_normal_force == pytest.approx(0.5)
    assert facts(frequency_ratio=0.0, phase=-2.0, normal_amplitude=3.0).mean_normal_force == 0.0


def test_slow_beat_reports_its_frequency() -> None:
    found = repeating_periods(facts(frequency_ratio=1.001), 20)
    assert isinstance(found, Obstacle)
    assert found.status == "slow_beat"
    assert "slow beat at 0.557042 Hz" in found.reason
    assert repeating_periods(facts(frequency_ratio=1.5), 20) == 2


@pytest.mark.parametrize(
    ("ratio", "status"),
    [
        (1.0999, "slow_beat"),
        (2.9001, "slow_beat"),
        (-0.9871, "slow_beat"),
        (1.1001, "no_common_period"),
        (1.37, "no_common_period"),
        (-2.4567, "no_common_period"),
    ],
)
def test_slow_beat_needs_a_ratio_near_an_integer(ratio: float, status: str) -> None:
    found = repeating_periods(facts(frequency_ratio=ratio), 20)
    assert isinstance(found, Obstacle)
    assert found.status == status
    assert f"frequency_ratio = {ratio!r} is no p/q with q <= 20" in found.reason
    assert ("Hz" in found.reason) == (status == "slow_beat"), "a fast beat is none"


def test_facts_are_read_from_the_fmu(instance: Instance) -> None:
    read = read_facts(instance, {"friction_faces": 1.0, "load": 0.05})
    assert (read["friction_faces"], read["load"], read["slider_mass"]) == (1.0, 0.05, 1.0)
    assert read.friction_limit == pytest.approx(0.1)
    assert np.isfinite(read.steady_velocity)


@pytest.mark.parametrize("stiffness", [None, 50.0, 1e5])
def test_maps_can_be_chained(instance: Instance, stiffness: float | None) -> None:
    """What is read at the end of a period must start the next one as if there were no end."""
    values, start = {"tolerance": 1e-12}, np.array([0.1, 1e-4, -0.2])
    if stiffness:
        values |= {"friction_law": 1.0, "bristle_stiffness": stiffness}
        start = np.append(start, 0.3 / stiffness * 0.1)
    facts = read_facts(instance, values)
    period_map = FmuPeriodMap(instance, values, facts, 2)
    assert ("bristle_deflection" in period_map.names) == bool(stiffness)
    first, moved = period_map(start, 0.01)
    second, further = period_map(first, 0.01)
    assert period_map.periods == 4
    end, displacement = FmuPeriodMap(instance, values, facts, 4)(start, 0.01)
    allowed = 1e-9 if stiffness else 1e-11
    assert end == pytest.approx(second, rel=allowed)
    assert displacement == pytest.approx(moved + further, rel=allowed)


def test_warm_up_gives_state_scale_and_mean(instance: Instance) -> None:
    period_map = FmuPeriodMap(instance, {}, read_facts(instance, {}), 1)
    warm = period_map.warm_up(0.1, 0.0)
    assert period_map.periods == 20
    assert np.all(warm.scale >= np.abs(warm.state))
    assert 0.0 < warm.mean_velocity < 0.3


def test_device_at_rest_has_positive_scales(instance: Instance) -> None:
    values = {"base_amplitude": 0.0}
    period_map = FmuPeriodMap(instance, values, read_facts(instance, values), 1)
    warm = period_map.warm_up(0.0, 0.0)
    assert np.all(warm.state == 0.0)
    assert np.all(warm.scale > 0.0)
    assert period_map.stick_fraction == 1.0
