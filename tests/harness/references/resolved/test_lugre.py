from __future__ import annotations

import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.peers import event_free
from tests.harness.references.comparing import assert_agree, split
from tests.harness.references.lugre_problems import DURATION, PROBLEMS, STIFF, TIMES, constant

QUIET = Device(
    friction_law=1,
    base_amplitude=0.0,
    normal_amplitude=0.0,
    resonator_mass=1e-9,
    bristle_damping=0.0,
)
"""A slider that nothing shakes, its resonator too light to matter."""


QUICK = ("table 1", "ratio 1.37, lift-off", "deep presliding", "schedule", "1e6")


@pytest.mark.parametrize(
    "name",
    [
        pytest.param(name, marks=() if name in QUICK else pytest.mark.slow)
        for name in [*PROBLEMS, *STIFF]
    ],
)
def test_scipy_agrees(name: str) -> None:
    device, held = (PROBLEMS | STIFF)[name]
    found = event_free.simulate(device, held, TIMES, rtol=1e-13, atol=1e-15)
    assert_agree(simulate(device, held, TIMES), found, allowed=1e-8)


@pytest.mark.parametrize("name", ["table 1", "ratio 1.37, lift-off", "schedule", "one face"])
def test_reversals_lift_offs_and_touchdowns_are_located(name: str) -> None:
    device, held = PROBLEMS[name]
    exact = simulate(device, held, TIMES)
    assert len(exact.event_times) > 4
    events = exact.event_times
    reverses = np.isin(events, exact.reversal_times)
    found, before, after = (
        event_free.simulate(device, held, events + late) for late in (0.0, -1e-9, 1e-9)
    )
    slow = 1e-9 * np.abs(np.gradient(exact.velocity, TIMES)).max()
    assert np.abs(found.velocity[reverses]).max() < slow, "within 1e-9 s of a reversal"
    assert (before.velocity * after.velocity < 0.0).tolist() == reverses.tolist()
    assert ((before.normal_force > 0.0) != (after.normal_force > 0.0)).tolist() == (
        ~reverses
    ).tolist(), "all other events are lift-offs and touchdowns"
    assert found.reversals == exact.reversals


@pytest.mark.parametrize("name", [*PROBLEMS, *STIFF])
def test_splitting_the_inputs_changes_nothing(name: str) -> None:
    device, held = (PROBLEMS | STIFF)[name]
    whole = simulate(device, held, TIMES)
    assert_agree(whole, simulate(device, split(held, 20), TIMES), allowed=1e-12)


@pytest.mark.parametrize("stiffness", [1e3, 1e5, 1e8])
@pytest.mark.parametrize("faces", [1, 2])
def test_presliding_rings_at_the_bristle_frequency(stiffness: float, faces: int) -> None:
    device = replace(QUIET, bristle_stiffness=stiffness, friction_faces=faces)
    frequency = math.sqrt(faces * stiffness / (device.slider_mass + device.resonator_mass))
    amplitude = 1e-7 * device.friction_coefficient / stiffness
    device = replace(device, initial_velocity=amplitude * frequency)
    period = 2.0 * math.pi / frequency
    times = np.linspace(0.0, 3.3 * period, 100)
    motion = simulate(device, [HeldInputs(0.0, times[-1])], times)
    swing = amplitude * np.sin(frequency * times)
    assert motion.position == pytest.approx(swing, abs=2e-6 * amplitude), (
        "a motion far below break-away is that of a mass on springs faces N s0"
    )
    assert motion.reversals == 7, "the velocity reverses every half period"


def test_presliding_is_damped_by_the_bristles() -> None:
    stiffness, damping = 1e5, 50.0
    device = replace(QUIET, bristle_stiffness=stiffness, bristle_damping=damping)
    mass = device.slider_mass + device.resonator_mass
    decay = damping / mass
    frequency = math.sqrt(2.0 * stiffness / mass - decay**2)
    device = replace(device, initial_velocity=1e-12)
    motion = simulate(device, constant(), TIMES)
    expected = 1e-12 / frequency * np.exp(-decay * TIMES) * np.sin(frequency * TIMES)
    allowed = 1e-5 * np.abs(expected).max()
    assert motion.position == pytest.approx(expected, abs=allowed), "their damping is faces N s1"


@pytest.mark.parametrize("direction", [1.0, -1.0])
@pytest.mark.parametrize("stiffness", [1e4, 1e8])
def test_steady_sliding_stretches_the_bristle_to_its_limit(
    direction: float, stiffness: float
) -> None:
    device = replace(QUIET, bristle_stiffness=stiffness, initial_velocity=5.0 * direction)
    motion = simulate(device, constant(), TIMES)
    assert motion.bristle_deflection[-1] == pytest.approx(0.1 * direction / stiffness, rel=1e-12), (
        "in steady sliding z = mu / s0 along the motion"
    )
    assert motion.friction_force[-1] == pytest.approx(0.2 * direction, rel=1e-12), "F = faces mu N"


def test_bristle_relaxes_along_the_path() -> None:
    device = replace(
        QUIET, bristle_stiffness=50.0, initial_velocity=1.0, initial_bristle_deflection=-3e-3
    )
    motion = simulate(device, constant(), TIMES)
    expected = 2e-3 - 5e-3 * np.exp(-500.0 * motion.position)
    assert motion.bristle_deflection == pytest.approx(expected, rel=1e-12, abs=1e-16), (
        "dz/dx = 1 - s0 z / mu"
    )


def test_bristle_keeps_evolving_in_flight() -> None:
    device = replace(QUIET, bristle_stiffness=1e3, initial_velocity=0.01, normal_preload=0.0)
    motion = simulate(device, constant(), TIMES)
    expected = 1e-4 * -np.expm1(-1e4 * 0.01 * TIMES)
    assert (motion.contact_mode == 2).all(), "without preload the contact is open"
    assert not motion.friction_force.any(), "an open contact has no friction"
    assert motion.velocity == pytest.approx(0.01, rel=1e-9), "nothing brakes a flight"
    assert motion.bristle_deflection == pytest.approx(expected, rel=1e-9), "(8) holds in flight"


@pytest.mark.parametrize(
    ("parameters", "low", "high"),
    [({}, 3.0, 30.0), ({"normal_amplitude": 2.0}, 3.0, 30.0), ({"fidelity": 1}, 8.0, 12.0)],
    ids=["closed", "lifts", "rigid"],
)
def test_stiff_bristles_approach_coulomb(
    parameters: dict[str, float], low: float, high: float
) -> None:
    """A reversal lacks friction over a path of mu / s0, for a time that falls as s0^-1/2."""
    device = Device.from_mapping({**parameters, "friction_law": 1, "bristle_damping": 0.0})
    coulomb = simulate(replace(device, friction_law=0), constant(phase=0.4), TIMES)
    errors = []
    for stiffness in (1e6, 1e8, 1e10):
        stiff = replace(device, bristle_stiffness=stiffness)
        motion = simulate(stiff, constant(phase=0.4), TIMES)
        errors.append(float(np.abs(motion.velocity - coulomb.velocity).max()))
        assert motion.reversals == coulomb.reversals, "the same reversals"
    ratios = [sooner / later for sooner, later in pairwise(errors)]
    assert all(low < ratio < high for ratio in ratios), (
        f"velocities {errors} off Coulomb's: 100 times the stiffness brings them about 10 closer"
    )
    assert errors[-1] < 5e-6, f"friction is Coulomb's, velocities differ by {errors[-1]} m/s"


def test_contact_mode_is_the_sign_of_the_velocity_or_lifted() -> None:
    device, held = PROBLEMS["ratio 1.37, lift-off"]
    motion = simulate(device, held, TIMES)
    lifted = motion.normal_force == 0.0
    assert 0.2 < lifted.mean() < 0.5, "about a third of the time the contact is open"
    assert (motion.contact_mode[lifted] == 2).all(), "lifted where the normal force is 0"
    signs = np.sign(motion.velocity[~lifted][1:])
    assert (motion.contact_mode[~lifted][1:] == signs).all(), "else the sign of the velocity"
    assert motion.sticks == 0, "bristles never stick"


def test_slider_at_rest_without_drive_stays() -> None:
    motion = simulate(QUIET, constant(), TIMES)
    assert not motion.velocity.any(), "nothing moves it"
    assert motion.reversals == 0, "no motion, no reversal"


def test_samples_at_starts_and_stops_are_kept() -> None:
    device, held = PROBLEMS["schedule"]
    edges = np.array([inputs.start for inputs in held] + [DURATION])
    motion = simulate(device, held, edges)
    assert motion.position.shape == edges.shape, "one sample for each time"
    assert simulate(device, held, np.empty(0)).position.shape == (0,), "no times, no samples"
