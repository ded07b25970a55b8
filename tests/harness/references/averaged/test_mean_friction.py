"""Averages of friction: against quadrature, closed forms and resolved motion."""

import math

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged import averaged_coulomb as coulomb
from slider_resonator.references.averaged import uniform_average
from slider_resonator.references.averaged import vibrating_contact as contact
from slider_resonator.references.averaged.averaged_motion import slow_start
from slider_resonator.references.averaged.device_average import blocking_force, steady_velocity
from slider_resonator.references.averaged.uniform_average import LugreCase
from slider_resonator.references.resolved.simulate import simulate


@pytest.mark.parametrize("ratio", [-3.0, -1.0, 0.0, 1.0, 2.0, 5.0])
@pytest.mark.parametrize("velocity", [-0.9, -0.2, 0.0, 0.4, 1.1])
@pytest.mark.parametrize("alpha", [0.7, 1.4, 20.0])
def test_mean_friction_is_its_integral(velocity: float, ratio: float, alpha: float) -> None:
    strength, phase = 0.8, 0.6
    turn = math.acos(max(-1.0, min(1.0, velocity / strength)))

    def integral(start: float, end: float) -> float:
        angles = start + (np.arange(100_000) + 0.5) / 100_000 * (end - start)
        load = np.maximum(0.0, 1.0 + alpha * np.sin(ratio * angles + phase))
        return float(load.mean()) * (end - start)

    forward, backward = integral(turn, 2.0 * math.pi - turn), integral(-turn, turn)
    mean = (forward - backward) / (2.0 * math.pi)
    found = coulomb.mean_friction(velocity, strength, alpha, phase, ratio)
    assert found == pytest.approx(mean, abs=3e-8), "the closed form is the mean over one turn"


def test_slow_start_is_the_momentum_of_the_drive() -> None:
    """Without friction, damped resonator: the mean velocity after its transient, exactly."""
    device = Device(friction_coefficient=0.0, tangential_force=30.0, damping_ratio=0.3)
    period = 2.0 * math.pi / device.drive_frequency
    times = np.array([0.0, 40.0, 60.0]) * period
    motion = simulate(device, [HeldInputs(0.0, times[-1])], times)
    mean = (motion.position[2] - motion.position[1]) / (20.0 * period)
    assert slow_start(device) == pytest.approx(mean, rel=1e-6)


@pytest.mark.parametrize(("velocity", "stiffness"), [(-0.6, 20.0), (0.0, 20.0), (0.3, 1000.0)])
@pytest.mark.parametrize(("ratio", "amplitude_ratio"), [(1, 0.8), (3, 1.9)])
def test_integrated_bristle_has_the_mean_friction(
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


@pytest.mark.parametrize(
    ("amplitude_ratio", "ratio", "turns"),
    [(1.0, 2.0, 1), (1.0, 1.5, 0), (1.1, 1.5, 2), (3.0, -2 / 3, 3), (3.0, 0.25, 4), (3.0, 0.2, 0)],
)
def test_turns_until_a_load_repeats(amplitude_ratio: float, ratio: float, turns: int) -> None:
    assert contact.turns_until_repeat(amplitude_ratio, ratio) == turns


@pytest.mark.parametrize("ratio", [-1, 0, 1, 2, 3, 1.37, 60])
@pytest.mark.parametrize("amplitude_ratio", [0.7, 2.5])
def test_stiff_bristle_approaches_coulomb_friction(ratio: float, amplitude_ratio: float) -> None:
    case = LugreCase(strength=1.0, amplitude_ratio=amplitude_ratio, phase=0.6, damping=0.0)
    for velocity in (-1.5, -0.4, 0.0, 0.8):
        expected = 0.4 * coulomb.mean_friction(velocity, 1.0, amplitude_ratio, 0.6, ratio)
        found = uniform_average.mean_friction(velocity, case, 1e14, 100.0, ratio)
        assert found == pytest.approx(expected, abs=1e-6)


@pytest.mark.parametrize(("alpha", "ratio"), [(0.8, 1.0), (1.8, 1.0), (1.8, 3.0), (1.8, 1.5)])
def test_blocking_force_stops_the_motion(alpha: float, ratio: float) -> None:
    device = Device(normal_amplitude=alpha)
    force = blocking_force(device, 0.7, ratio)
    velocity = steady_velocity(device, 0.7, force, ratio)
    assert velocity == pytest.approx(0.0, abs=1e-12), "the velocity under the blocking force is 0"
