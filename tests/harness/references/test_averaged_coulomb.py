from __future__ import annotations

import math

import numpy as np
import pytest
from scipy.integrate import quad

from harness.references import averaged_coulomb as coulomb
from harness.references.closed_forms import device_steady_velocity, loaded_velocity
from harness.references.device import Device
from harness.references.held_inputs import HeldInputs
from harness.references.located_events import simulate
from harness.references.slow_course import slow_course


@pytest.mark.parametrize("ratio", [-3.0, -1.0, 0.0, 1.0, 2.0, 3.0, 5.0])
@pytest.mark.parametrize("velocity", [-0.9, -0.2, 0.0, 0.4, 1.1])
def test_mean_friction_is_the_integral_over_a_turn(velocity: float, ratio: float) -> None:
    strength, alpha, phase = 0.8, 0.7, 0.6
    turn = math.acos(max(-1.0, min(1.0, velocity / strength)))

    def friction(angle: float) -> float:
        sign = math.copysign(1.0, velocity - strength * math.cos(angle))
        return sign * (1.0 + alpha * math.sin(ratio * angle + phase))

    arcs = ((-turn, turn), (turn, 2.0 * math.pi - turn))
    mean = sum(quad(friction, *arc)[0] for arc in arcs) / (2.0 * math.pi)
    found = coulomb.mean_friction(velocity, strength, alpha, phase, ratio)
    assert found == pytest.approx(mean, abs=1e-10), "the closed form is the mean over one turn"


def test_away_from_integers_only_the_mean_load_counts() -> None:
    tuned = [coulomb.mean_friction(0.3, 1.0, 1.0, phase, 1.5) for phase in (0.0, 1.0)]
    assert tuned[0] == tuned[1] == coulomb.mean_friction(0.3, 1.0, 0.0, 0.0)


def test_ratio_one_is_the_theory_of_the_paper() -> None:
    for load in (-0.3, 0.0, 0.5):
        assert coulomb.steady_velocity_at_ratio(1.3, 0.8, 0.7, 1.0, load) == pytest.approx(
            loaded_velocity(1.3, 0.8, 0.7, load), rel=1e-12
        )
    assert coulomb.device_steady_velocity_at_ratio(Device(), 0.4, 1.0, 0.05) == pytest.approx(
        device_steady_velocity(Device(), 0.4, 0.05), rel=1e-12
    )


@pytest.mark.parametrize(
    ("ratio", "phase", "velocity"),
    [
        (1, 0.0, 0.6966),
        (1, 1.5, 0.7719),
        (3, 0.0, -0.2780),
        (3, 1.5, 0.2036),
        (5, 0.0, -0.1169),
        (5, 1.5, -0.1795),
        (7, 0.0, 0.1297),
        (7, 1.5, -0.0600),
    ],
)
def test_odd_ratios_meet_the_exact_motion_of_table_1(
    ratio: int, phase: float, velocity: float
) -> None:
    found = coulomb.device_steady_velocity_at_ratio(Device(), phase, ratio) / (2.0 / 11.0)
    assert found == pytest.approx(velocity, abs=5e-4), "in x0 w0, the average errs by 1 / Omega"


def test_linear_acceleration_is_the_slope_at_rest() -> None:
    step = 1e-5
    for velocity in (0.0, step):
        exact = coulomb.slow_acceleration(velocity, 0.9, 0.6, 0.8)
        linear = coulomb.linear_slow_acceleration(velocity, 0.9, 0.6, 0.8)
        assert linear == pytest.approx(exact, abs=1e-9), "(6) is (4) for small velocities"


def test_linear_beat_is_where_the_linear_slow_motion_settles() -> None:
    strength, alpha, detuning = 1.0, 0.1, 1.5
    times = np.linspace(0.0, 40.0 * math.pi / detuning, 4001)

    def acceleration(time: float, velocity: float) -> float:
        phase = coulomb.drifting_phase(time, detuning, 0.3)
        return coulomb.linear_slow_acceleration(velocity, strength, alpha, phase)

    position, velocity = slow_course(acceleration, times)
    late = times > times[-1] - 2.0 * math.pi / detuning
    assert np.ptp(velocity[late]) / 2.0 == pytest.approx(
        coulomb.linear_beat_velocity(strength, alpha, detuning), rel=1e-4
    )
    assert np.ptp(position[late]) / 2.0 == pytest.approx(
        coulomb.linear_beat_displacement(strength, alpha, detuning), rel=1e-4
    )


def test_a_device_from_rest_has_the_momentum_of_its_drive() -> None:
    """Without friction, damped resonator: the mean velocity after its transient, exactly."""
    device = Device(friction_coefficient=0.0, tangential_force=30.0, damping_ratio=0.3)
    period = 2.0 * math.pi / device.drive_frequency
    times = np.array([0.0, 400.0 * period, 500.0 * period])
    motion = simulate(device, [HeldInputs(0.0, times[-1])], times)
    mean = (motion.position[2] - motion.position[1]) / (100.0 * period)
    assert coulomb.slow_start(device) == pytest.approx(mean, rel=1e-6)


def test_what_has_no_answer_is_refused_by_name() -> None:
    with pytest.raises(ValueError, match=r"load = 1\.0"):
        coulomb.steady_velocity_at_ratio(1.0, 1.0, 0.0, 3.0, 1.0)
    with pytest.raises(ValueError, match=r"amplitude_ratio = 1\.2"):
        coulomb.mean_friction(0.0, 1.0, 1.2, 0.0)
    with pytest.raises(ValueError, match="strength = 0"):
        coulomb.mean_friction(0.0, 0.0, 1.0, 0.0)
    with pytest.raises(ValueError, match="detuning = 0"):
        coulomb.linear_beat_displacement(1.0, 1.0, 0.0)
