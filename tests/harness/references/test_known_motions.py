"""Motions with closed forms, also under inputs and parameters that change."""

import math
from dataclasses import replace
from fractions import Fraction

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import simulate_averaged
from slider_resonator.references.averaged.device_average import blocking_force, steady_velocity
from slider_resonator.references.equivalent_force import equivalent_force
from slider_resonator.references.phase import Elapsed, advanced
from slider_resonator.references.resolved.contact import LIFTED, STICK
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory

FREQUENCY = 3500.0
AMPLITUDE = 1e-4
STOP = 0.2
TIMES = np.linspace(0.0, STOP, 701)
TURNED = FREQUENCY * TIMES
ALLOWED = 2e-13
"""Deviation in fractions of the peak."""

RIGID = {"resonator_mass": 0.0, "base_amplitude": 0.0, "normal_amplitude": 0.0}
FREE = {"normal_preload": 0.0, "normal_amplitude": 0.0}
BUILT_IN = {"friction_coefficient": 1e6, "normal_amplitude": 0.0, "damping_ratio": 0.0}
RESONANT = {"damping_ratio": 0.0, "resonator_frequency": FREQUENCY * np.sqrt(1.0 / 1.1)}
OPENING = {"base_amplitude": 0.0, "normal_amplitude": 2.0, "drive_frequency": 40.0}

SLIDING = np.minimum(TIMES, 0.1)
SECULAR = 0.5 * AMPLITUDE * (np.sin(TURNED) - TURNED * np.cos(TURNED))
"""Undamped oscillator driven at its own frequency from rest."""
MOMENTUM = 0.1 * AMPLITUDE * FREQUENCY * (1.0 - np.cos(TURNED))
"""Of the base excitation; a free slider has it less that of the resonator."""
RECOIL = (MOMENTUM - 0.1 * 0.5 * AMPLITUDE * FREQUENCY * TURNED * np.sin(TURNED)) / 1.1


def deviation(run: Trajectory, signal: str, exact: Array) -> float:
    return float(np.abs(getattr(run, signal) - exact).max() / np.abs(exact).max())


MOTIONS: dict[str, tuple[dict[str, float], float, dict[str, Array], list[float], int]] = {
    "constant friction slides to a stop and sticks": (
        *(RIGID | {"initial_velocity": 0.02}, 0.0),
        *({"position": 0.02 * SLIDING - 0.1 * SLIDING**2}, [0.1], 1),
    ),
    "free flight under a load": (
        *(RIGID | FREE | {"initial_velocity": 0.3, "initial_position": -1.0}, 0.5),
        *({"position": -1.0 + 0.3 * TIMES - 0.25 * TIMES**2}, [], 0),
    ),
    "undamped resonator on a held slider at resonance": (
        *(BUILT_IN, 0.0, {"resonator_displacement": SECULAR}, [], 0),
    ),
    "undamped resonator on a free slider at resonance, with its recoil": (
        *(FREE | RESONANT, 0.0, {"resonator_displacement": SECULAR, "velocity": RECOIL}, [], 0),
    ),
    "lifting off and touching down without any force": (
        *(OPENING, 0.0, {"normal_force": np.maximum(0.0, 1.0 + 2.0 * np.sin(40.0 * TIMES))}),
        *([7.0 * np.pi / 240.0, 11.0 * np.pi / 240.0], 1),
    ),
}
"""Parameters and load, signals, and times of changes of contact mode, with sticks among them."""


@pytest.mark.parametrize("name", MOTIONS)
def test_motion_matches_the_closed_form(name: str) -> None:
    parameters, load, signals, event_times, sticks = MOTIONS[name]
    run = simulate(Device.from_mapping(parameters), [HeldInputs(0.0, STOP, load=load)], TIMES)
    for signal, exact in signals.items():
        assert deviation(run, signal, exact) <= ALLOWED, signal
    assert run.event_times == pytest.approx(event_times, rel=1e-12), "changes of contact mode"
    assert np.count_nonzero(run.modes[1:] == STICK) == sticks
    assert run.reversal_times.size == 0, "nothing here turns round"


def test_slider_breaks_loose_where_the_drive_exceeds_friction() -> None:
    """0.4 sin(w t) N reaches 0.2 N of friction at w t = pi / 6; before the first reversal."""
    times = np.linspace(0.0, 3.5 / FREQUENCY, 301)
    device = Device.from_mapping(RIGID | {"tangential_force": 0.4})
    run = simulate(device, [HeldInputs(0.0, STOP)], times)
    release = np.pi / 6.0
    turned = np.maximum(FREQUENCY * times, release)
    push = 0.4 * (np.cos(release) - np.cos(turned)) - 0.2 * (turned - release)
    assert deviation(run, "velocity", np.maximum(push, 0.0) / FREQUENCY) <= ALLOWED
    assert run.event_times[0] == pytest.approx(release / FREQUENCY, rel=1e-13)
    assert run.contact_mode[np.searchsorted(times, run.event_times[0])] == 1


def test_contact_changes_of_a_chirp_are_exact() -> None:
    chirp = HeldInputs(0.0, 0.03, 0.2, 0.01, 1.0, ratio_rate=13.0)
    run = simulate(Device(normal_amplitude=1.6), [chirp], np.array([chirp.stop]))
    changes = run.event_times[np.flatnonzero(np.diff(run.modes == 2))]
    assert len(changes) > 10
    angle = 0.2 + 3500.0 * (changes + 0.5 * 13.0 * changes**2)
    assert np.abs(1.0 + 1.6 * np.sin(angle)).max() < 1e-11


def test_flight_under_a_chirp_that_fades_is_seen() -> None:
    """1 + 3 sin(-1.1) < 0: the contact is open, though the chirp ends before it would touch."""
    held = HeldInputs(0.0, 9e-5, phase=-1.1, frequency_ratio=0.1, ratio_rate=-1000.0)
    motion = simulate(Device(normal_amplitude=3.0), [held], np.array([9e-5]))
    assert motion.contact_mode[-1] == LIFTED


def test_another_drive_frequency_changes_a_rate_and_no_phase() -> None:
    """Without friction a rigid slider under F sin(theta) has M v = F (1 - cos theta) / w."""
    slider = Device(resonator_mass=0.0, friction_coefficient=0.0, tangential_force=2.0)
    inputs = [
        HeldInputs(0.0, 0.3, tuned=(("drive_frequency", 10.0),)),
        HeldInputs(0.3, 0.6, tuned=(("drive_frequency", 17.0),)),
    ]
    motion = simulate(slider, inputs, np.array([0.3, 0.6]))
    first = 2.0 * (1.0 - math.cos(3.0)) / 10.0
    second = first + 2.0 * (math.cos(3.0) - math.cos(3.0 + 17.0 * 0.3)) / 17.0
    assert motion.velocity == pytest.approx([first, second], rel=1e-12)
    angle = np.array([3.0, 3.0 + 17.0 * 0.3])
    assert motion.normal_force == pytest.approx(np.maximum(0.0, 1.0 + np.sin(angle)))


@pytest.mark.parametrize("at", [0.0501, 0.0504, 0.0507])
def test_averaged_motion_takes_over_what_the_resolved_device_has(at: float) -> None:
    """Whatever the angle at which the drive changes, the slow velocity must be that of the pair."""
    device = Device(damping_ratio=0.2)
    inputs = [
        HeldInputs(0.0, at, tuned=(("base_amplitude", 1e-4), ("drive_frequency", 3500.0))),
        HeldInputs(at, 0.15, tuned=(("base_amplitude", 5e-5), ("drive_frequency", 3200.0))),
    ]
    period = 2.0 * math.pi / 3200.0
    times = 0.15 - np.array([1.0, 0.0]) * period
    resolved = simulate(device, inputs, times)
    mean = float(np.diff(resolved.position)[0]) / period
    averaged = simulate_averaged(device, inputs, times)
    jump = 0.1 * 3500.0 * 5e-5 / 1.1
    assert float(averaged.mean_velocity.mean()) == pytest.approx(mean, abs=0.03 * jump)


def test_many_steps_lose_no_digits() -> None:
    turn = Fraction(2.0 * math.pi) + Fraction(2.4492935982947064e-16)
    angle, plain = 0.0, 0.0
    for _ in range(100_000):
        angle = advanced(angle, 0.37)
        plain += 0.37
    exact = 100_000 * Fraction(0.37)
    exact -= round(exact / turn) * turn
    assert abs(Fraction(angle) - exact) < 1e-11, "rounding of single steps is all that adds up"
    assert abs(math.remainder(plain, 2.0 * math.pi) - exact) > 1e-10, "a plain sum is far worse"


def test_elapsed_time_keeps_the_rounding_of_its_steps() -> None:
    elapsed = Elapsed()
    for _ in range(100_000):
        elapsed.add(1e-3 / 3.0)
    exact = 100_000 * Fraction(1e-3 / 3.0)
    found = Fraction(elapsed.seconds) + Fraction(elapsed.carry)
    assert abs(found - exact) < Fraction(1e-17), "a plain sum is off by 1e-11 here"


TABLE_1 = Device()


def test_table_1_figures() -> None:
    force = equivalent_force(TABLE_1)
    assert force.amplitude == pytest.approx(910.947, abs=5e-4), "F_T* in N"
    assert force.angle == pytest.approx(0.733313, abs=5e-7), "phi = theta1 in rad at phase 0"
    assert force.ripple_amplitude == pytest.approx(67.603e-6, abs=5e-10), "ripple in m"
    velocity = steady_velocity(TABLE_1, 0.0, 0.0, 1.0)
    assert velocity == pytest.approx(0.126731, abs=5e-7), "steady velocity of (5) in m/s"
    blocking = blocking_force(TABLE_1, 0.0, 1.0)
    assert blocking == pytest.approx(0.085222, abs=5e-7), "blocking force of both faces in N"


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
    """Fig. 6 without friction, from the claimed steady state on: it must stay in it."""
    force = equivalent_force(device)
    frequency, turned = device.drive_frequency, -force.resonator_angle
    steady = replace(
        device,
        friction_coefficient=0.0,
        initial_velocity=-force.velocity_amplitude * math.cos(force.angle),
        initial_resonator_displacement=force.resonator_amplitude * math.sin(turned),
        initial_resonator_velocity=frequency * force.resonator_amplitude * math.cos(turned),
    )
    times = np.linspace(0.0, 6.0 * math.pi / frequency, 50)
    run = simulate(steady, [HeldInputs(0.0, times[-1])], times)
    velocity = -force.velocity_amplitude * np.cos(frequency * times - force.angle)
    allowed = 1e-7 * force.velocity_amplitude
    assert run.velocity == pytest.approx(velocity, abs=allowed), "as under F_T* alone, (33)"
    resonator = force.resonator_amplitude * np.sin(frequency * times + turned)
    allowed = 1e-7 * abs(force.resonator_amplitude)
    assert run.resonator_displacement == pytest.approx(resonator, abs=allowed), "as (32) says"
