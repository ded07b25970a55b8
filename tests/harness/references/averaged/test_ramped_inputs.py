"""Averaged references under inputs that change at constant rates."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.averaged.averaged_motion import (
    in_slow_phases,
    simulate_averaged,
    slow_ratio,
)
from slider_resonator.references.averaged.averaged_outputs import averaged_outputs

STOP = 0.3
TIMES = np.linspace(0.0, STOP, 40)
LINE = HeldInputs(0.0, STOP, 0.2, 0.01, 1.0, phase_rate=2.0, load_rate=0.3)
LOAD = replace(LINE, phase_rate=0.0)
DEVICE = Device(fidelity=0)
FLIES = replace(DEVICE, normal_amplitude=1.4)
LUGRE = replace(DEVICE, friction_law=1, bristle_stiffness=1e4)


def first_order(device: Device, held: Sequence[HeldInputs], times: Array) -> Array:
    return simulate_averaged(device, held, times).position


def staircase(line: HeldInputs, count: int) -> list[HeldInputs]:
    size = STOP / count
    return [
        replace(
            line.later((i + 0.5) * size),
            start=i * size,
            stop=(i + 1) * size,
            phase_rate=0.0,
            load_rate=0.0,
            ratio_rate=0.0,
        )
        for i in range(count)
    ]


@pytest.mark.parametrize("device", [DEVICE, LUGRE])
def test_held_steps_tend_to_the_line(device: Device) -> None:
    line = first_order(device, [LINE], TIMES)
    errors = [np.abs(first_order(device, staircase(LINE, n), TIMES) - line).max() for n in (10, 40)]
    assert errors[1] < errors[0] / 10.0
    assert errors[1] < 1e-4 * np.abs(line).max()


def test_cutting_the_line_changes_nothing() -> None:
    cut = [replace(LINE, stop=0.11), LINE.later(0.11)]
    whole = first_order(DEVICE, [LINE], TIMES)
    assert np.abs(first_order(DEVICE, cut, TIMES) - whole).max() < 1e-10 * np.abs(whole).max()


def test_the_normal_force_has_the_phase_of_the_ramp() -> None:
    motion = simulate_averaged(DEVICE, [LINE], TIMES)
    found = averaged_outputs(DEVICE, [LINE], motion).normal_force
    angle = 3500.0 * TIMES + 0.2 + 2.0 * TIMES
    assert np.abs(found - (1.0 + np.sin(angle))).max() < 1e-11


@pytest.mark.parametrize(("device", "rate", "order"), [(DEVICE, 0.5, 1.8), (FLIES, 0.9, 0.0)])
def test_held_steps_tend_to_a_ratio_that_grows(device: Device, rate: float, order: float) -> None:
    """Of second order within a slow phase; at its edges friction jumps."""
    growing = HeldInputs(0.0, STOP, 0.2, 0.01, 0.93, ratio_rate=rate)
    line = first_order(device, [growing], TIMES)
    errors = [
        np.abs(first_order(device, staircase(growing, n), TIMES) - line).max() for n in (100, 400)
    ]
    assert order == 0.0 or errors[1] < errors[0] / 4.0**order
    assert errors[1] < 1e-3 * np.abs(line).max()


def test_the_edges_of_slow_phases_are_cut() -> None:
    growing = HeldInputs(0.0, 1.0, 0.2, 0.01, 0.95, ratio_rate=0.3)
    closed, lifts = (in_slow_phases([growing], device) for device in (DEVICE, FLIES))
    ratios = [inputs.frequency_ratio for inputs in closed]
    assert ratios == pytest.approx([0.95, 1.1])
    assert len(lifts) > len(closed), "fractions have slow phases in flight"
    for inputs in lifts:
        ends = (inputs.frequency_ratio, inputs.later(inputs.stop - inputs.start).frequency_ratio)
        inside = [slow_ratio(FLIES, ends[0] + s * (ends[1] - ends[0])) for s in (0.01, 0.99)]
        assert inside[0][0] == inside[1][0]


def test_ramps_that_are_not_covered_are_refused() -> None:
    block = replace(DEVICE, base_amplitude=0.0)
    with pytest.raises(ValueError, match=r"load_rate = 0\.3: must be 0"):
        simulate_averaged(block, [LOAD], TIMES)


def test_a_load_beyond_friction_takes_the_slider_through_the_vibration() -> None:
    """In one line or in many, though the integrator may step far where friction is constant."""
    device = Device(fidelity=0, friction_coefficient=0.75948, initial_velocity=0.45596)
    line = HeldInputs(0.0, 0.1394, -1.758, 4.3372, 1.0, load_rate=-60.69)
    times = np.array([0.0, 0.1394])
    cuts = np.linspace(0.0, 0.1394, 101)
    parts = [
        replace(line.later(float(start)), start=float(start), stop=float(stop))
        for start, stop in pairwise(cuts)
    ]
    whole, fine = (first_order(device, held, times)[-1] for held in ([line], parts))
    assert whole == pytest.approx(fine, rel=1e-8)
