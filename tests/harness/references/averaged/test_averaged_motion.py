"""Averages of friction, and averaged motion: its order, its inputs and where it holds."""

import math
from dataclasses import replace
from itertools import pairwise
from typing import Any

import numpy as np
import pytest
from numpy.polynomial import Polynomial
from scipy.integrate import solve_ivp

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged import averaged_coulomb as coulomb
from slider_resonator.references.averaged import uniform_average
from slider_resonator.references.averaged import vibrating_contact as contact
from slider_resonator.references.averaged.averaged_motion import (
    simulate_averaged,
    slow_start,
    slow_trajectory,
)
from slider_resonator.references.averaged.device_average import (
    blocking_force,
    prediction_valid,
    stable_velocity,
    steady_velocity,
)
from slider_resonator.references.averaged.uniform_average import LugreCase
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.references.resolved.simulate import simulate

PERIOD = 2.0 * np.pi / 3500.0
COULOMB = Device(fidelity=0)
BRISTLES = Device(fidelity=0, friction_law=1)
STRONG_FRICTION = 0.5
"""It moves the slow velocity by a fair share of v_q within 100 drive periods."""


def at_factor(device: Device, factor: float) -> Device:
    """The device at a higher drive frequency: fast velocity, slow motion and kappa stay."""
    return replace(
        device,
        base_amplitude=device.base_amplitude / factor,
        drive_frequency=device.drive_frequency * factor,
        resonator_frequency=device.resonator_frequency * factor,
        bristle_stiffness=device.bristle_stiffness * factor,
        initial_resonator_displacement=device.initial_resonator_displacement / factor,
    )


CASES: dict[str, tuple[Device, dict[str, Any]]] = {
    "Coulomb": (COULOMB, {"phase": 0.4, "load": 0.05}),
    "Coulomb, lifting": (replace(COULOMB, normal_amplitude=2.0), {"phase": 0.4}),
    "Coulomb, lifting, ratio 1.37": (
        replace(COULOMB, normal_amplitude=2.0),
        {"frequency_ratio": 1.37, "load": 0.1},
    ),
    "soft": (replace(BRISTLES, bristle_stiffness=2e3, bristle_damping=2.0), {"phase": 0.4}),
    "hard": (replace(BRISTLES, bristle_stiffness=1e7), {"phase": 0.4}),
    "medium, ratio 3": (
        replace(BRISTLES, bristle_stiffness=3e4),
        {"phase": 0.4, "frequency_ratio": 3.0},
    ),
    "medium, lifting": (replace(BRISTLES, normal_amplitude=2.0), {"phase": -0.4}),
    "medium, overload": (BRISTLES, {"load": -1.4}),
}
QUICK = ("Coulomb, lifting", "soft")


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in CASES]
)
def test_error_falls_with_the_drive_frequency(name: str) -> None:
    device, inputs = CASES[name]
    device = replace(device, friction_coefficient=STRONG_FRICTION)
    held = [HeldInputs(0.0, 100.0 * PERIOD, **inputs)]
    times = np.linspace(0.0, held[0].stop, 21)
    errors = []
    for factor in (1.0, 4.0):
        faster = at_factor(device, factor)
        averaged = simulate_averaged(faster, held, times)
        resolved = simulate(replace(faster, fidelity=2), held, times)
        errors.append(float(np.abs(averaged.position - resolved.position).max()))
    moved = equivalent_force(device).velocity_amplitude * 100.0 * PERIOD
    assert errors[0] < 0.012 * moved, "the position within about 1 % of v_q times time"
    assert errors[1] < 0.4 * errors[0], f"errors {errors} must fall as 1 / Omega"


def test_phase_is_slow_up_to_a_detuning_of_one_tenth() -> None:
    held = [HeldInputs(0.0, 1.0, 0.4, frequency_ratio=ratio) for ratio in (1.0999, 1.1001)]
    times = np.linspace(0.0, 1.0, 100)
    beating, still = (simulate_averaged(COULOMB, [inputs], times) for inputs in held)
    assert (np.diff(still.mean_velocity) < 0.0).all(), "without a slow phase V only decays"
    assert (np.diff(beating.mean_velocity) > 0.0).any(), "with one it swings"


@pytest.mark.parametrize("law", [0, 1])
def test_friction_and_load_are_the_rate_of_momentum(law: int) -> None:
    device = Device(fidelity=0, normal_amplitude=1.3, friction_law=law, friction_faces=1)
    held = [HeldInputs(0.0, 20.3 * PERIOD, phase=0.4)]
    times = np.linspace(0.0, held[0].stop, 201)
    motion = simulate_averaged(device, held, times)
    friction = motion.friction_force
    impulse = np.sum(0.5 * (friction[1:] + friction[:-1]) * np.diff(times))
    change = motion.mean_velocity[-1] - motion.mean_velocity[0]
    assert device.total_mass * change == pytest.approx(-impulse, rel=1e-4)


def test_forward_one_of_two_stable_velocities_is_returned() -> None:
    """v^3 - 0.25 v has its stable roots at +-0.5; the shift says where the slider sets off."""
    for shift, side in ((-1e-6, 1.0), (1e-6, -1.0)):
        cubic = Polynomial([shift, -0.25, 0.0, 1.0])
        found = stable_velocity(cubic, 1.0, 0.0)
        assert found == pytest.approx(side * 0.5, abs=1e-4)


def test_trajectory_decays_toward_a_terminal_velocity() -> None:
    times = np.linspace(0.0, 3.0, 7)
    position, velocity = slow_trajectory(lambda time, v: 1.0 - v, times, velocity=0.5)
    assert velocity == pytest.approx(1.0 - 0.5 * np.exp(-times), abs=1e-6)
    assert position == pytest.approx(times - 0.5 * (1.0 - np.exp(-times)), abs=1e-6)


TABLE_1 = Device()


def test_a_load_of_full_friction_is_the_limit() -> None:
    assert prediction_valid(TABLE_1, 0.0, 0.1999, 1.0)
    assert not prediction_valid(TABLE_1, 0.0, 0.2001, 1.0)
    lifting = replace(TABLE_1, normal_preload=0.0)
    assert prediction_valid(lifting, 0.0, 0.199 / math.pi, 1.0), "its mean over a turn counts"
    assert not prediction_valid(lifting, 0.0, 0.201 / math.pi, 1.0)
    assert prediction_valid(TABLE_1, math.pi / 2.0, 0.39, 0.0), "at ratio 0 the load that stands"


def test_no_vibration_no_prediction() -> None:
    assert not prediction_valid(replace(TABLE_1, base_amplitude=0.0), 0.0, 0.0, 1.0)
    free = math.sqrt(TABLE_1.slider_mass / TABLE_1.total_mass) * TABLE_1.drive_frequency
    resonant = replace(TABLE_1, damping_ratio=0.0, resonator_frequency=free)
    assert not prediction_valid(resonant, 0.0, 0.0, 1.0)
    assert prediction_valid(replace(resonant, resonator_frequency=3500.0), 0.0, 0.0, 1.0)


def test_a_block_is_held_by_what_the_load_needs() -> None:
    held = [HeldInputs(0.0, 0.1, load=0.07)]
    times = np.linspace(0.0, 0.1, 11)
    for velocity, friction in ((0.0, -0.07), (-1.0, -0.2)):
        block = Device(fidelity=0, base_amplitude=0.0, normal_amplitude=0.5)
        block = replace(block, initial_velocity=velocity)
        found = simulate_averaged(block, held, times).friction_force
        assert found == pytest.approx(np.full(11, friction))


OUTRUN = Device(fidelity=0, friction_coefficient=0.75948, initial_velocity=0.45596)


@pytest.mark.parametrize(
    ("device", "line"),
    [
        (OUTRUN, HeldInputs(0.0, 0.1394, -1.758, 4.3372, 1.0, load_rate=-60.69)),
        (COULOMB, HeldInputs(0.0, 0.3, 0.2, 0.01, 0.93, ratio_rate=0.5)),
    ],
    ids=["load beyond friction", "ratio into and out of a slow phase"],
)
def test_a_line_in_parts_is_the_line(device: Device, line: HeldInputs) -> None:
    """Though the integrator may step far where friction is constant."""
    times = np.array([0.0, line.stop])
    cuts = np.linspace(0.0, line.stop, 101).tolist()
    parts = [replace(line.later(a), start=a, stop=b) for a, b in pairwise(cuts)]
    whole, fine = (simulate_averaged(device, held, times).position[-1] for held in ([line], parts))
    assert whole == pytest.approx(fine, rel=1e-8)


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
        span, start = (0.0, 2.0 * math.pi), (bristle, 0.0)
        options = {"rtol": 1e-10, "atol": 1e-13, "max_step": 0.01}
        solution = solve_ivp(rates, span, start, "DOP853", **options)  # type: ignore[call-overload]
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
