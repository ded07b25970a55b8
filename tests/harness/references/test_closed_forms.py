from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import quad, solve_ivp

from slider_resonator.device.device import Device
from slider_resonator.references import closed_forms

TABLE_1 = Device()
SLIPPING_RESONANCE = {"damping_ratio": 0.0, "resonator_frequency": 3500.0 * math.sqrt(1.0 / 1.1)}


def mean_friction(velocity: float, strength: float, ratio: float, phase: float) -> float:
    """The friction of (2) averaged over one vibration, by quadrature instead of by (4)."""
    turn = math.acos(velocity / strength)

    def friction(angle: float) -> float:
        fast_velocity = velocity - strength * math.cos(angle)
        return math.copysign(1.0, fast_velocity) * (1.0 + ratio * math.sin(angle + phase))

    total, _ = quad(friction, 0.0, 2.0 * math.pi, points=[turn, 2.0 * math.pi - turn])
    return float(total) / (2.0 * math.pi)


@pytest.mark.parametrize(
    ("strength", "ratio", "phase", "load"),
    [(1.0, 1.0, 0.5, 0.0), (1.3, 0.6, 2.0, 0.2), (2.0, 0.9, -1.0, -0.4), (0.5, 0.0, 1.0, 0.7)],
)
def test_loaded_velocity_balances_the_averaged_friction(
    strength: float, ratio: float, phase: float, load: float
) -> None:
    velocity = closed_forms.loaded_velocity(strength, ratio, phase, load)
    friction = mean_friction(velocity, strength, ratio, phase)
    assert friction == pytest.approx(-load, abs=1e-9), "(20): mean friction and load cancel"


def test_velocity_is_largest_in_quadrature_and_odd_in_phase() -> None:
    velocities = [
        closed_forms.steady_velocity(1.0, 1.0, phase)
        for phase in (0.0, 0.5, math.pi / 2, 2.5, -0.5)
    ]
    assert max(velocities) == velocities[2], "the paper finds the greatest velocity at phase pi/2"
    assert velocities[0] == pytest.approx(0.0, abs=1e-12), "no phase, no direction"
    assert velocities[4] == pytest.approx(-velocities[1]), "a negative phase moves backward"


def test_linear_velocity_is_the_limit_of_the_steady_velocity() -> None:
    ratio, phase = 1e-3, 0.8
    exact = closed_forms.steady_velocity(1.3, ratio, phase)
    linear = closed_forms.linear_velocity(1.3, ratio, phase)
    assert linear == pytest.approx(1.3e-3 * math.sin(0.8)), "(7) is q alpha sin(phase)"
    assert exact == pytest.approx(linear, rel=1e-6), "(5) becomes (7) for small velocities"


def test_blocking_load_stops_the_motion() -> None:
    blocking = closed_forms.blocking_load(0.7, 1.1)
    velocity = closed_forms.loaded_velocity(1.3, 0.7, 1.1, blocking)
    assert velocity == pytest.approx(0.0, abs=1e-14), "(21) is the load of (20) at rest"


def test_table_1_figures() -> None:
    force = closed_forms.equivalent_force(TABLE_1)
    assert force.amplitude == pytest.approx(910.947, abs=5e-4), "F_T* in N"
    assert force.angle == pytest.approx(0.733313, abs=5e-7), "phi = theta1 in rad at phase 0"
    assert force.strength == pytest.approx(1.301353, abs=5e-7), "q"
    assert force.length_scale == pytest.approx(0.181818, abs=5e-7), "x0 in m"
    assert force.ripple_amplitude == pytest.approx(67.603e-6, abs=5e-10), "ripple in m"
    velocity = closed_forms.device_steady_velocity(TABLE_1, phase=0.0)
    assert velocity == pytest.approx(0.126731, abs=5e-7), "steady velocity of (5) in m/s"
    blocking = closed_forms.device_blocking_force(TABLE_1, phase=0.0)
    assert blocking == pytest.approx(0.085222, abs=5e-7), "blocking force of both faces in N"


def test_one_face_blocks_at_half_the_force() -> None:
    one = closed_forms.device_blocking_force(replace(TABLE_1, friction_faces=1), phase=0.3)
    force = closed_forms.equivalent_force(TABLE_1)
    expected = 2.0 / math.pi * 0.1 * 1.0 * math.sin(0.3 + force.angle)
    assert one == pytest.approx(expected), "(22) as printed holds for one face"


@pytest.mark.parametrize(
    "device",
    [
        TABLE_1,
        replace(TABLE_1, resonator_frequency=1500.0),
        replace(TABLE_1, resonator_frequency=6000.0, damping_ratio=0.4),
        replace(TABLE_1, tangential_force=300.0),
        replace(TABLE_1, tangential_force=2000.0, base_amplitude=0.0),
        replace(TABLE_1, resonator_frequency=1500.0, damping_ratio=0.0, tangential_force=-50.0),
    ],
    ids=["table 1", "above resonance", "damped", "both drives", "direct drive", "undamped"],
)
def test_equivalent_force_matches_the_frictionless_device(device: Device) -> None:
    """Integrate fig. 6 without friction from the claimed steady state: it must stay in it."""
    force = closed_forms.equivalent_force(device)
    frequency, mass = device.drive_frequency, device.resonator_mass

    def slopes(time: float, state: np.ndarray) -> list[float]:
        _, displacement, velocity = state
        spring = device.damping * velocity + device.stiffness * displacement
        push = device.tangential_force * math.sin(frequency * time)
        slider = (spring + push) / device.slider_mass
        base = device.base_amplitude * frequency**2 * math.sin(frequency * time)
        return [slider, velocity, base - spring / mass - slider]

    period = 2.0 * math.pi / frequency
    turned = -force.resonator_angle
    start = [
        -force.velocity_amplitude * math.cos(force.angle),
        force.resonator_amplitude * math.sin(turned),
        frequency * force.resonator_amplitude * math.cos(turned),
    ]
    times = np.linspace(0.0, 3.0 * period, 50)
    run = solve_ivp(
        slopes,
        (0.0, float(times[-1])),
        start,
        "DOP853",
        times,
        rtol=1e-11,
        atol=1e-16,
        max_step=1e-4,
    )
    velocity = -force.velocity_amplitude * np.cos(frequency * times - force.angle)
    allowed = 1e-7 * force.velocity_amplitude
    assert run.y[0] == pytest.approx(velocity, abs=allowed), "as under F_T* alone, (33)"
    resonator = force.resonator_amplitude * np.sin(frequency * times - force.resonator_angle)
    allowed = 1e-7 * abs(force.resonator_amplitude)
    assert run.y[1] == pytest.approx(resonator, abs=allowed), "as (32) says"


@pytest.mark.parametrize("load", [1.0, -1.0, 1.5, math.nan])
def test_load_above_friction_is_refused(load: float) -> None:
    with pytest.raises(ValueError, match=r"load = .*-1 and 1"):
        closed_forms.loaded_velocity(1.0, 1.0, 0.5, load)


@pytest.mark.parametrize("strength", [0.0, -1.0, math.nan])
def test_strength_without_vibration_is_refused(strength: float) -> None:
    with pytest.raises(ValueError, match=r"strength = .* greater than 0"):
        closed_forms.steady_velocity(strength, 1.0, 0.5)


@pytest.mark.parametrize("ratio", [-0.1, 1.1, math.nan])
def test_lifting_contact_is_refused(ratio: float) -> None:
    with pytest.raises(ValueError, match="between 0 and 1"):
        closed_forms.blocking_load(ratio, 0.5)


@pytest.mark.parametrize(
    ("changed", "load", "message"),
    [
        ({}, 0.25, r"load = 0\.25 N .* 0\.2 N"),
        ({"base_amplitude": 0.0}, 0.0, r"base_amplitude = 0\.0 m and tangential_force"),
        ({"normal_preload": 0.0}, 0.0, r"normal_preload = 0\.0 N must be greater than 0"),
        (SLIPPING_RESONANCE, 0.0, r"damping_ratio = 0\.0 .* greater than 0"),
    ],
)
def test_device_without_an_average_is_refused(
    changed: dict[str, float], load: float, message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        closed_forms.device_steady_velocity(Device.from_mapping(changed), phase=0.0, load=load)
