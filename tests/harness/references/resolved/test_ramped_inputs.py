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
from slider_resonator.references.resolved import (
    located_events,
    lugre_scipy,
    lugre_taylor,
    taylor,
)
from slider_resonator.references.resolved.contact import LIFTED

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
LUGRE = replace(DEVICE, friction_law=1, bristle_stiffness=1e4)


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


def position(device: Device, held: Sequence[HeldInputs], *, taylor_series: bool = True) -> Array:
    if device.friction_law:
        simulate = lugre_taylor.simulate_lugre if taylor_series else lugre_scipy.simulate_lugre
        return simulate(device, held, TIMES).position
    resolved = taylor.simulate if taylor_series else located_events.simulate
    return resolved(device, held, TIMES).position


def off(one: Array, other: Array) -> float:
    return float(np.abs(one - other).max() / np.abs(other).max())


@pytest.mark.parametrize("device", [DEVICE, LIFTS, STICKS, replace(LIFTS, fidelity=1)])
def test_both_coulomb_references_agree(device: Device) -> None:
    one, other = (position(device, [ALL], taylor_series=series) for series in (True, False))
    assert off(other, one) < 2e-10


@pytest.mark.parametrize("device", [LUGRE, replace(LUGRE, normal_amplitude=1.6)])
def test_both_lugre_references_agree(device: Device) -> None:
    one, other = (position(device, [ALL], taylor_series=series) for series in (True, False))
    assert off(other, one) < 2e-9


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
    run = taylor.simulate(LIFTS, [CHIRP], TIMES)
    changes = run.event_times[np.flatnonzero(np.diff(run.modes == 2))]
    assert len(changes) > 10
    angle = 0.2 + 3500.0 * (changes + 0.5 * 13.0 * changes**2)
    assert np.abs(1.0 + 1.6 * np.sin(angle)).max() < 1e-11


@pytest.mark.parametrize("device", [LIFTS, replace(LUGRE, normal_amplitude=1.6)])
def test_references_agree_under_a_normal_load_that_turns_back(device: Device) -> None:
    one, other = (position(device, [BACK], taylor_series=series) for series in (True, False))
    assert off(other, one) < 2e-9


def test_flight_under_a_chirp_that_fades_is_seen() -> None:
    """1 + 3 sin(-1.1) < 0: the contact is open, though the chirp ends before it would touch."""
    held = HeldInputs(0.0, 9e-5, phase=-1.1, frequency_ratio=0.1, ratio_rate=-1000.0)
    motion = located_events.simulate(Device(normal_amplitude=3.0), [held], np.array([9e-5]))
    assert motion.contact_mode[-1] == LIFTED
