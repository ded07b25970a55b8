"""Devices, under inputs and parameters that change too, against scipy with other equations."""

from collections.abc import Sequence
from dataclasses import replace
from functools import partial
from itertools import pairwise

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trading.peers import event_free, located_scipy
from tests.harness.references.comparing import assert_agree, until
from tests.problems import PROBLEMS

DEVICE = Device()
LIFTS = replace(DEVICE, normal_amplitude=1.6)
LUGRE = replace(DEVICE, friction_law=1, bristle_stiffness=1e4)
DEVICES = {
    "Coulomb": DEVICE,
    "Coulomb, lift-off": LIFTS,
    "Coulomb, sticking": replace(DEVICE, friction_coefficient=30.0),
    "Coulomb, fidelity 1": replace(LIFTS, fidelity=1),
    "LuGre": LUGRE,
    "LuGre, lift-off": replace(LUGRE, normal_amplitude=1.6),
    "LuGre, bent": replace(LUGRE, initial_bristle_deflection=1e-5),
}
ALL = HeldInputs(0.0, 0.03, 0.2, 0.01, 1.0, phase_rate=2.0, load_rate=3.0, ratio_rate=13.0)
BACK = HeldInputs(0.0, 0.03, 0.2, 0.01, frequency_ratio=0.4, ratio_rate=-40.0)
"""The normal load turns back."""
EDGES = (0.0, 2.1e-3, 4.7e-3, 7e-3)
NAMES = ("normal_preload", "base_amplitude", "drive_frequency", "friction_coefficient")
TUNED = ((1.0, 1e-4, 3500.0, 0.2), (1.3, 1e-4, 3300.0, 0.5), (1.3, 6e-5, 3600.0, 0.3))
TUNING = [
    HeldInputs(*times, phase=0.4, tuned=tuple(zip(NAMES, values, strict=True)))
    for times, values in zip(pairwise(EDGES), TUNED, strict=True)
]

Lugre = partial(Device, friction_law=1)
DURATION = {0: 0.06, 1: 0.012}
"""Of a run under constant inputs by friction law, s."""
BRISTLES = {
    "soft": Lugre(bristle_stiffness=1.0, bristle_damping=100.0),
    "undamped": Lugre(bristle_stiffness=1e3, bristle_damping=0.0),
    "deep presliding": Lugre(base_amplitude=1e-12, bristle_damping=100.0),
    "1e6": Lugre(bristle_stiffness=1e6),
    "1e8, presliding": Lugre(bristle_stiffness=1e8, base_amplitude=5e-8),
    "1e8, deep presliding": Lugre(bristle_stiffness=1e8, base_amplitude=1e-9, bristle_damping=0.0),
}

Case = tuple[Device, Sequence[HeldInputs], float]
"""A device, its inputs, and what each signal may be off by in fractions of its peak."""
CASES: dict[str, Case] = {
    **{
        f"{'LuGre' if law else 'Coulomb'}, {name}": (
            replace(one.device, friction_law=law),
            one.held if len(one.held) > 1 else [replace(one.held[0], stop=DURATION[law])],
            1e-8 if law else 3e-9,
        )
        for name, one in PROBLEMS.items()
        for law in ((0, 1) if one.device.friction_coefficient else (0,))
    },
    **{
        f"bristles: {name}": (device, until(DURATION[1], phase=0.4, load=0.05), 1e-8)
        for name, device in BRISTLES.items()
    },
    **{f"lines: {name}": (device, [ALL], 2e-9) for name, device in DEVICES.items()},
    **{f"back: {name}": (device, [BACK], 2e-9) for name, device in DEVICES.items()},
    **{
        f"tuned: {name}": (device, TUNING, 1e-7 if device.friction_law else 1e-9)
        for name, device in DEVICES.items()
    },
}
QUICK = (
    *("Coulomb, table 1", "Coulomb, lift-off with sticking", "LuGre, table 1", "LuGre, one face"),
    *("Coulomb, undamped, sticking resonance", "bristles: ", "lines: ", "tuned: "),
)


def by_scipy(device: Device, held: Sequence[HeldInputs], times: Array) -> Trajectory:
    if device.friction_law:
        return event_free.simulate(device, held, times, rtol=1e-13, atol=1e-15)
    return located_scipy.simulate(device, held, times)


@pytest.mark.parametrize(
    "name", [pytest.param(n, marks=() if n.startswith(QUICK) else pytest.mark.slow) for n in CASES]
)
def test_scipy_agrees(name: str) -> None:
    device, held, allowed = CASES[name]
    times = np.linspace(0.0, held[-1].stop, 201)
    expected, found = simulate(device, held, times), by_scipy(device, held, times)
    assert_agree(expected, found, allowed)
    if not device.friction_law:
        assert found.event_times == pytest.approx(expected.event_times, rel=1e-10, abs=1e-14)


def test_slips_within_a_long_step_are_found() -> None:
    """Of a soft resonator the slider reverses twice in a quarter of the fastest period."""
    problem = PROBLEMS["soft resonator"]
    held, times = [replace(problem.held[0], stop=0.03)], np.linspace(0.0, 0.03, 101)
    exact = simulate(problem.device, held, times)
    other = located_scipy.simulate(
        problem.device, held, times, rtol=1e-8, atol=1e-10, steps_per_period=4
    )
    assert len(other.event_times) == len(exact.event_times)


@pytest.mark.parametrize(
    ("device", "inputs"),
    [
        (Lugre(normal_amplitude=2.0), {"frequency_ratio": 1.37}),
        (Lugre(friction_faces=1, friction_coefficient=0.3), {"phase": 1.0}),
    ],
)
def test_events_of_bristles_are_located(device: Device, inputs: dict[str, float]) -> None:
    held = until(DURATION[1], **inputs)
    times = np.linspace(0.0, DURATION[1], 121)
    exact = simulate(device, held, times)
    assert len(exact.event_times) > 4
    events = exact.event_times
    reverses = np.isin(events, exact.reversal_times)
    found, before, after = (
        event_free.simulate(device, held, events + late) for late in (0.0, -1e-9, 1e-9)
    )
    slow = 1e-9 * np.abs(np.gradient(exact.velocity, times)).max()
    opens = (before.normal_force > 0.0) & (after.normal_force == 0.0)
    closes = (before.normal_force == 0.0) & (after.normal_force > 0.0)
    stops = ~(opens | closes)
    assert np.abs(found.velocity[stops]).max() < slow, "within 1e-9 s of a reversal"
    assert (before.velocity * after.velocity < 0.0).tolist() == stops.tolist()
    assert reverses[stops].all(), "all events but lift-offs and touchdowns are reversals"
    assert not reverses[opens].any()
    if not closes.any():  # else the slider turns in the air, too, and slides back from touchdown on
        assert found.reversal_times.size == exact.reversal_times.size
