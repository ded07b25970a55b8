"""Steady motion and blocking force with LuGre friction, where the bristle is part of the state."""

from __future__ import annotations

from math import pi

import pytest

from slider_resonator.device.device import Device
from slider_resonator.fmu.instance import Instance
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.steady.reference_steady import (
    reference_blocking_force,
    reference_steady_velocity,
)
from slider_resonator.steady.steady_velocity import find_steady

PERIOD = 2.0 * pi / 3500.0
LUGRE = {"friction_law": 1.0}


@pytest.mark.parametrize(("fidelity", "stiffness"), [(1.0, 1e4), (2.0, 50.0), (2.0, 1e6)])
def test_soft_and_hard_bristles_match_the_reference(
    instance: Instance, fidelity: float, stiffness: float
) -> None:
    changed = {**LUGRE, "fidelity": fidelity, "bristle_stiffness": stiffness, "tolerance": 1e-11}
    device = Device.from_mapping(changed)
    motion, blocking = find_steady(instance, changed), find_blocking(instance, changed)
    assert (motion.status, blocking.status) == ("steady", "blocked")
    assert motion.periods <= 100, "as few as with Coulomb friction"
    assert blocking.periods <= 100, "as few as with Coulomb friction"
    velocity = reference_steady_velocity(device, 0.0, 0.0, 1.0, motion.predicted)
    force = reference_blocking_force(device, 0.0, 1.0, blocking.predicted)
    assert motion.steady_velocity == pytest.approx(velocity, abs=1e-7), "the bristle as a state"
    assert blocking.blocking_force == pytest.approx(force, abs=1e-7), "the bristle as a state"


@pytest.mark.parametrize("stiffness", [50.0, 3e3, 1e6])
@pytest.mark.parametrize(
    "changed",
    [
        {"phase": -pi / 2.0},  # the normal force vanishes at the end of each period
        {"phase": -1.2, "normal_amplitude": 3.0},  # lifted there
        {"phase": 4.2, "normal_amplitude": 30.0, "frequency_ratio": -1.0},  # half the period
        {"phase": -2.0, "normal_amplitude": 2.0, "frequency_ratio": 0.5},
        {"phase": -1.5, "normal_amplitude": 1.5, "frequency_ratio": 1.5},
        {"phase": 0.4, "frequency_ratio": 3.0},
        {"phase": 0.4, "load": 0.05},
        {"normal_preload": 0.0},
    ],
)
def test_run_from_the_steady_state_stays_there(
    instance: Instance, stiffness: float, changed: dict[str, float]
) -> None:
    values = {**LUGRE, "bristle_stiffness": stiffness, "tolerance": 1e-11, **changed}
    motion = find_steady(instance, values)
    assert motion.status == "steady"
    assert motion.common_period is not None
    instance.start({**values, **{f"initial_{name}": x for name, x in motion.state.items()}})
    begin = instance.value("position")
    for period in range(1, 51):
        instance.step_to(period * motion.common_period * PERIOD)
    mean = (instance.value("position") - begin) / instance.time
    assert mean == pytest.approx(motion.steady_velocity, abs=1e-9)
    assert instance.value("velocity") == pytest.approx(motion.state["velocity"], abs=1e-9)


@pytest.mark.parametrize("stiffness", [1.0, 50.0, 1e3, 1e5])
@pytest.mark.parametrize("velocity", [-0.23, -0.05, 0.0, 0.23])
def test_search_converges_from_any_velocity(
    instance: Instance, stiffness: float, velocity: float
) -> None:
    values = {**LUGRE, "bristle_stiffness": stiffness}
    near = find_steady(instance, values)
    far = find_steady(instance, {**values, "initial_velocity": velocity})
    assert far.status == "steady"
    assert far.steady_velocity == pytest.approx(near.steady_velocity, abs=1e-8)


def test_damped_bristles_hold_loads_above_sliding_friction(instance: Instance) -> None:
    """(24) can exceed mu N0: a load above full sliding friction is no obstacle of its own."""
    soft = {**LUGRE, "bristle_stiffness": 50.0}
    motion = find_steady(instance, {**soft, "load": 0.5})
    assert motion.status == "steady"
    assert motion.steady_velocity is not None
    assert motion.steady_velocity > 0.1
    over = find_steady(instance, {**soft, "load": 2.5})
    assert over.steady_velocity is None
    assert over.status == "load_above_friction"


def test_hard_bristles_approach_coulomb_at_the_theoretical_rate(instance: Instance) -> None:
    """The bristle is bent over a path of mu / s0 from each reversal, hence a time of s0^(-1/2)."""
    coulomb = find_steady(instance, {}).steady_velocity
    gaps = []
    for stiffness in (1e10, 1e12):
        values = {**LUGRE, "bristle_stiffness": stiffness, "tolerance": 1e-12}
        velocity = find_steady(instance, values).steady_velocity
        assert coulomb is not None
        assert velocity is not None
        gaps.append(abs(velocity - coulomb))
    assert gaps[0] / gaps[1] == pytest.approx(10.0, rel=0.02)
