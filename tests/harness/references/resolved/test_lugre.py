import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.peers import event_free
from tests.harness.references.comparing import assert_agree
from tests.harness.references.lugre_problems import PROBLEMS, STIFF, TIMES, constant

QUIET = Device(
    friction_law=1,
    base_amplitude=0.0,
    normal_amplitude=0.0,
    resonator_mass=1e-9,
    bristle_damping=0.0,
)
"""A slider that nothing shakes, its resonator too light to matter."""


QUICK = ("deep presliding", "schedule", "1e8, presliding")


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


@pytest.mark.parametrize("name", ["ratio 1.37, lift-off", "one face"])
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
