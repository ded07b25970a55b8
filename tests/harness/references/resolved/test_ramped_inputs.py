"""References under inputs that change at constant rates, with each other and with held steps."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.contact import LIFTED
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.peers import event_free, located_scipy

STOP = 0.03
TIMES = np.linspace(0.0, STOP, 200)
DEVICE = Device()
PHASE = HeldInputs(0.0, STOP, 0.2, 0.01, 1.0, phase_rate=2.0)
LOAD = HeldInputs(0.0, STOP, 0.2, 0.01, 1.0, load_rate=3.0)
CHIRP = HeldInputs(0.0, STOP, 0.2, 0.01, 1.0, ratio_rate=13.0)
BACK = HeldInputs(0.0, STOP, 0.2, 0.01, frequency_ratio=0.4, ratio_rate=-40.0)
"""The normal load turns back."""
ALL = HeldInputs(0.0, STOP, 0.2, 0.01, 1.0, phase_rate=2.0, load_rate=3.0, ratio_rate=13.0)
LIFTS = replace(DEVICE, normal_amplitude=1.6)
STICKS = replace(DEVICE, friction_coefficient=30.0)
RIGID = replace(LIFTS, fidelity=1)
LUGRE = replace(DEVICE, friction_law=1, bristle_stiffness=1e4)
LUGRE_LIFTS = replace(LUGRE, normal_amplitude=1.6)


def cut(inputs: HeldInputs, count: int) -> list[HeldInputs]:
    """Return the same lines in intervals, the first of them shorter."""
    edges = [0.0, *np.linspace(0.1, 1.0, count) * inputs.stop]
    return [replace(inputs.later(begin), stop=end) for begin, end in pairwise(edges)]


def staircase(inputs: HeldInputs, count: int) -> list[HeldInputs]:
    """Return steps that hold the values in the middle of each."""
    size = inputs.stop / count
    still = {"phase_rate": 0.0, "load_rate": 0.0, "ratio_rate": 0.0}
    return [
        replace(inputs.later((i + 0.5) * size), start=i * size, stop=(i + 1) * size, **still)
        for i in range(count)
    ]


def position(device: Device, held: Sequence[HeldInputs]) -> Array:
    return simulate(device, held, TIMES).position


def by_scipy(device: Device, held: Sequence[HeldInputs]) -> Array:
    follow = event_free.simulate if device.friction_law else located_scipy.simulate
    return follow(device, held, TIMES).position


def off(one: Array, other: Array) -> float:
    return float(np.abs(one - other).max() / np.abs(other).max())


@pytest.mark.parametrize("inputs", [ALL, BACK])
@pytest.mark.parametrize("device", [DEVICE, LIFTS, STICKS, RIGID, LUGRE, LUGRE_LIFTS])
def test_scipy_agrees(device: Device, inputs: HeldInputs) -> None:
    assert off(by_scipy(device, [inputs]), position(device, [inputs])) < 2e-9


@pytest.mark.parametrize("device", [LIFTS, STICKS, LUGRE])
def test_cutting_lines_into_pieces_changes_nothing(device: Device) -> None:
    assert off(position(device, cut(ALL, 7)), position(device, [ALL])) < 1e-11


@pytest.mark.parametrize(
    ("device", "inputs"),
    [
        (DEVICE, PHASE),
        (DEVICE, CHIRP),
        (LUGRE, LOAD),
        (LIFTS, BACK),
        (replace(LUGRE, normal_amplitude=1.6), BACK),
    ],
)
def test_held_steps_tend_to_the_line_with_second_order(device: Device, inputs: HeldInputs) -> None:
    line = position(device, [inputs])
    coarse, fine = (off(position(device, staircase(inputs, n)), line) for n in (200, 800))
    assert fine < 1e-4
    assert fine < coarse / 8.0, "sixteen, but for where steps lie in a period"


def test_a_ramp_of_the_phase_is_a_shift_of_the_normal_frequency() -> None:
    shifted = HeldInputs(0.0, STOP, 0.2, 0.01, 1.0 + 2.0 / 3500.0)
    assert off(position(DEVICE, [PHASE]), position(DEVICE, [shifted])) < 1e-13


def test_contact_changes_of_a_chirp_are_exact() -> None:
    run = simulate(LIFTS, [CHIRP], TIMES)
    changes = run.event_times[np.flatnonzero(np.diff(run.modes == 2))]
    assert len(changes) > 10
    angle = 0.2 + 3500.0 * (changes + 0.5 * 13.0 * changes**2)
    assert np.abs(1.0 + 1.6 * np.sin(angle)).max() < 1e-11


def test_flight_under_a_chirp_that_fades_is_seen() -> None:
    """1 + 3 sin(-1.1) < 0: the contact is open, though the chirp ends before it would touch."""
    held = HeldInputs(0.0, 9e-5, phase=-1.1, frequency_ratio=0.1, ratio_rate=-1000.0)
    motion = simulate(Device(normal_amplitude=3.0), [held], np.array([9e-5]))
    assert motion.contact_mode[-1] == LIFTED
