"""Motion of second order from rest against resolved motion, and how long it is resolved."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs, TunedInputs
from slider_resonator.references.averaged.motion_from_start import (
    SWING_LEFT,
    simulate_from_start,
    turns_resolved,
)
from slider_resonator.references.resolved import located_events, lugre_taylor, taylor

DEVICE = Device(friction_coefficient=0.5)
TURN = 2.0 * math.pi / DEVICE.drive_frequency
SCIPY_ERRORS = (1e-11, 1e-9)
"""Errors of the integrators of scipy in 30 turns, as shares of the signals, by friction law."""


@pytest.mark.parametrize("law", [0, 1])
def test_it_is_resolved_motion_at_first_and_close_to_it_later(law: int) -> None:
    device = replace(DEVICE, friction_law=law)
    turns = turns_resolved(device)
    held = [HeldInputs(0.0, 30.3 * TURN, 0.3), HeldInputs(30.3 * TURN, 90.0 * TURN, 0.3, 0.05)]
    times = np.linspace(0.0, 90.0, 40) * TURN
    exact = (lugre_taylor.simulate_lugre if law else taylor.simulate)(device, held, times)
    found = simulate_from_start(device, held, times)
    early = times < (turns - 0.5) * TURN
    assert 0 < early.sum() < len(times)
    for name, scale in (("position", 0.01), ("velocity", 0.3), ("resonator_velocity", 2.4)):
        apart = np.abs(getattr(found, name) - getattr(exact, name)) / scale
        assert apart[early].max() < SCIPY_ERRORS[law]
        assert 0.0 < apart[~early].max() < 3e-6


def test_a_run_that_ends_while_it_swings_is_resolved_throughout() -> None:
    held, times = [HeldInputs(0.0, 5.0 * TURN)], np.linspace(0.0, 5.0 * TURN, 7)
    exact = located_events.simulate(DEVICE, held, times)
    assert np.array_equal(simulate_from_start(DEVICE, held, times).position, exact.position)


@pytest.mark.parametrize("damping_ratio", [0.005, 0.05, 0.9, 1.5])
def test_a_free_oscillation_decays_to_the_stated_share(damping_ratio: float) -> None:
    device = replace(DEVICE, damping_ratio=damping_ratio)
    period = 2.0 * math.pi / device.drive_frequency
    share = device.slider_mass / device.total_mass
    wn = device.resonator_frequency
    swing = np.array([[0.0, 1.0], [-(wn**2) / share, -2.0 * damping_ratio * wn / share]])
    values, vectors = np.linalg.eig(swing)
    slowest = np.abs(np.exp(values * period)).max()
    turns = turns_resolved(device)
    assert slowest**turns <= SWING_LEFT < slowest ** (turns - 1)
    assert np.linalg.matrix_rank(vectors) == 2


def test_what_it_does_not_cover_is_refused() -> None:
    times = np.array([0.0])
    with pytest.raises(ValueError, match="damping_ratio = 0"):
        simulate_from_start(replace(DEVICE, damping_ratio=0.0), [HeldInputs(0.0, 1.0)], times)
    tuned = TunedInputs(0.0, 1.0, tuned=(("normal_preload", 2.0),))
    with pytest.raises(ValueError, match="tuned parameters"):
        simulate_from_start(DEVICE, [tuned], times)
    with pytest.raises(ValueError, match=r"begin at 0\.5 s"):
        simulate_from_start(DEVICE, [HeldInputs(0.5, 1.0)], times + 0.5)
