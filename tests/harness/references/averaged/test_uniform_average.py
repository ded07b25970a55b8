from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from slider_resonator.device.device import Device
from slider_resonator.references.averaged import uniform_average
from slider_resonator.references.averaged.averaged_coulomb import mean_friction as coulomb_friction
from slider_resonator.references.averaged.device_average import stable_velocity, steady_velocity
from slider_resonator.references.averaged.uniform_average import LugreCase
from slider_resonator.references.equivalent_force import equivalent_force

CASE = LugreCase()


@pytest.mark.parametrize(("velocity", "stiffness"), [(-0.6, 20.0), (0.0, 20.0), (0.3, 1000.0)])
@pytest.mark.parametrize(("ratio", "amplitude_ratio"), [(1, 0.8), (3, 1.9)])
def test_mean_friction_matches_an_integrated_bristle(
    velocity: float, stiffness: float, ratio: int, amplitude_ratio: float
) -> None:
    """The bristle as a state under the prescribed velocity, over the turn that it repeats.

    Its equation is linear, so that two turns tell from where a third one ends where it began.
    """
    case = LugreCase(strength=0.9, amplitude_ratio=amplitude_ratio, phase=0.7, damping=0.6)
    frequency = 100.0

    def rates(angle: float, state: np.ndarray) -> tuple[float, float]:
        speed = velocity - case.strength * math.cos(angle)
        bristle = speed - stiffness * abs(speed) * state[0] / case.friction_coefficient
        friction = stiffness * state[0] + case.damping * bristle
        load = max(0.0, 1.0 + case.amplitude_ratio * math.sin(ratio * angle + case.phase))
        return bristle / frequency, load * friction

    def turn(bristle: float) -> tuple[float, float]:
        """Deflection after a turn and mean friction over it, from a deflection."""
        solution = solve_ivp(
            rates,
            (0.0, 2.0 * math.pi),
            (bristle, 0.0),
            method="DOP853",
            rtol=1e-10,
            atol=1e-13,
            max_step=0.02 if stiffness == 20.0 else 0.01,
        )
        end, friction = solution.y[:, -1]
        return float(end), float(friction) / (2.0 * math.pi)

    size = case.friction_coefficient / stiffness
    from_none, _ = turn(0.0)
    from_some, _ = turn(size)
    repeating = from_none / (1.0 - (from_some - from_none) / size)
    end, mean = turn(repeating)
    assert end == pytest.approx(repeating, abs=1e-7 * size), "the bristle repeats"
    found = uniform_average.mean_friction(velocity, case, stiffness, frequency, ratio)
    assert found == pytest.approx(mean, abs=2e-7), "the explicit periodic response is the response"


@pytest.mark.parametrize("ratio", [-1, 0, 1, 2, 3, 1.37, 60])
@pytest.mark.parametrize("amplitude_ratio", [0.7, 2.5])
def test_stiff_bristle_approaches_coulomb_friction_at_every_velocity(
    ratio: float, amplitude_ratio: float
) -> None:
    case = LugreCase(strength=1.0, amplitude_ratio=amplitude_ratio, phase=0.6, damping=0.0)
    for velocity in (-1.5, -0.4, 0.0, 0.8):
        expected = 0.4 * coulomb_friction(velocity, 1.0, amplitude_ratio, 0.6, ratio)
        found = uniform_average.mean_friction(velocity, case, 1e14, 100.0, ratio)
        assert found == pytest.approx(expected, abs=1e-6)


def test_units_do_not_matter() -> None:
    """Table 1 in SI units against the same case made dimensionless."""
    device = Device(friction_law=1)
    force = equivalent_force(device)
    mass, load = device.total_mass, 2.0 * device.normal_preload
    case = LugreCase(
        strength=force.velocity_amplitude * mass / load,
        phase=0.4 + force.angle,
        friction_coefficient=0.1,
        damping=device.bristle_damping * load / mass,
    )
    stiffness = 1e5 * load / mass
    scaled = stable_velocity(
        lambda velocity: uniform_average.mean_friction(velocity, case, stiffness, 3500.0),
        case.strength,
        0.0,
    )
    assert steady_velocity(device, 0.4, 0.0, 1.0) == pytest.approx(scaled * load / mass, rel=1e-9)


@pytest.mark.parametrize(("stiffness", "frequency"), [(0.0, 1.0), (1.0, 0.0), (math.nan, 1.0)])
def test_invalid_arguments_are_refused_by_name(stiffness: float, frequency: float) -> None:
    with pytest.raises(ValueError, match="must be greater than 0"):
        uniform_average.mean_friction(0.1, CASE, stiffness, frequency)


@pytest.mark.parametrize(
    ("name", "value"),
    [("strength", 0.0), ("friction_coefficient", -0.1), ("damping", -1.0), ("amplitude_ratio", -1)],
)
def test_an_invalid_case_is_refused_by_name(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=name):
        LugreCase(**{name: value})
