from __future__ import annotations

import math

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged import averaged_coulomb as coulomb
from slider_resonator.references.averaged.averaged_motion import slow_start
from slider_resonator.references.averaged.device_average import blocking_force, steady_velocity
from slider_resonator.references.averaged.vibrating_contact import mean_load
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.steady.reference_steady import reference_steady_velocity


@pytest.mark.parametrize("ratio", [-3.0, -1.0, 0.0, 1.0, 2.0, 5.0])
@pytest.mark.parametrize("velocity", [-0.9, -0.2, 0.0, 0.4, 1.1])
@pytest.mark.parametrize("alpha", [0.7, 1.4, 20.0])
def test_mean_friction_is_the_integral_over_a_turn(
    velocity: float, ratio: float, alpha: float
) -> None:
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


@pytest.mark.parametrize("alpha", [1.0, 1.8])
def test_noninteger_ratio_depends_on_the_mean_load_only(alpha: float) -> None:
    tuned = [coulomb.mean_friction(0.3, 1.0, alpha, phase, 1.37) for phase in (0.0, 1.0)]
    still = coulomb.mean_friction(0.3, 1.0, 0.0, 0.0)
    assert tuned[0] == tuned[1] == mean_load(alpha) * still


@pytest.mark.parametrize("ratio", [1.0, 3.0])
def test_mean_friction_is_continuous_at_lift_off(ratio: float) -> None:
    for velocity in (-0.6, 0.1, 0.9):
        closed, lifting = (
            coulomb.mean_friction(velocity, 1.0, alpha, 0.7, ratio) for alpha in (1.0, 1.0 + 1e-9)
        )
        assert lifting == pytest.approx(closed, abs=2e-9), "nothing jumps where the contact lifts"


def steady_by_shooting(device: Device, phase: float, load: float, ratio: int) -> float:
    """Mean velocity in m/s of the motion that repeats, by the integrator with located events."""
    guess = steady_velocity(device, phase, load, float(ratio))
    found = reference_steady_velocity(device, phase, load, float(ratio), guess)
    assert found is not None, "the device slides steadily"
    return found


@pytest.mark.parametrize(
    ("alpha", "phase", "ratio", "load"),
    [(2.0, 0.4, 1, 0.0), (2.0, 0.4, 1, 0.08), (1.3, 0.0, 3, 0.0), (6.0, 1.5, 1, 0.3)],
)
def test_average_predicts_a_lifting_contact(
    alpha: float, phase: float, ratio: int, load: float
) -> None:
    """Table 1 at its drive frequency and at four times that, the fast velocity kept."""
    errors = []
    for factor in (1.0, 4.0):
        device = Device(
            fidelity=1,
            normal_amplitude=alpha,
            base_amplitude=1e-4 / factor,
            drive_frequency=3500.0 * factor,
            resonator_frequency=3500.0 * factor,
        )
        average = steady_velocity(device, phase, load, float(ratio))
        error = average - steady_by_shooting(device, phase, load, ratio)
        errors.append(error / equivalent_force(device).velocity_amplitude)
    assert abs(errors[0]) < 0.01, "1 % of the fast velocity"
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05), "averages err by 1 / Omega"


def test_slow_start_is_the_momentum_of_the_drive() -> None:
    """Without friction, damped resonator: the mean velocity after its transient, exactly."""
    device = Device(friction_coefficient=0.0, tangential_force=30.0, damping_ratio=0.3)
    period = 2.0 * math.pi / device.drive_frequency
    times = np.array([0.0, 40.0, 60.0]) * period
    motion = simulate(device, [HeldInputs(0.0, times[-1])], times)
    mean = (motion.position[2] - motion.position[1]) / (20.0 * period)
    assert slow_start(device) == pytest.approx(mean, rel=1e-6)


@pytest.mark.parametrize(("alpha", "ratio"), [(0.8, 1.0), (1.8, 1.0), (1.8, 3.0), (1.8, 1.5)])
def test_blocking_force_stops_the_motion(alpha: float, ratio: float) -> None:
    device = Device(normal_amplitude=alpha)
    force = blocking_force(device, 0.7, ratio)
    velocity = steady_velocity(device, 0.7, force, ratio)
    assert velocity == pytest.approx(0.0, abs=1e-12), "the velocity under the blocking force is 0"


def test_invalid_arguments_are_refused_by_name() -> None:
    with pytest.raises(ValueError, match=r"load = 0\.201"):
        steady_velocity(Device(), 0.0, 0.201, 3.0)
    with pytest.raises(ValueError, match=r"amplitude_ratio = -0\.2"):
        coulomb.mean_friction(0.0, 1.0, -0.2, 0.0)
    with pytest.raises(ValueError, match="strength = 0"):
        coulomb.mean_friction(0.0, 0.0, 1.0, 0.0)
    with pytest.raises(ValueError, match=r"load = 0\.32"):
        steady_velocity(Device(normal_amplitude=3.0), 0.0, 0.32, 1.0)
