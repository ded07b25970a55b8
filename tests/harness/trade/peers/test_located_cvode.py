"""CVODE with root finding against closed forms and the Taylor reference."""

from __future__ import annotations

import math

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved import taylor
from slider_resonator.trade.peers.located_cvode import simulate
from tests.harness.references.known_motions import (
    FIRST_SLIP,
    KNOWN_MOTIONS,
    STOP,
    KnownMotion,
)

PERIOD = 2.0 * math.pi / 3500.0
TOLERANCE = 1e-10
SEVERAL = (
    "constant friction slides to a stop and sticks",
    "free flight under a load",
    "lifting off and touching down without any force",
)


@pytest.mark.parametrize("motion", [KNOWN_MOTIONS[name] for name in SEVERAL], ids=SEVERAL)
def test_a_known_motion(motion: KnownMotion) -> None:
    times = np.linspace(0.0, STOP, 41)
    run = simulate(motion.device, motion.held, times, tolerance=TOLERANCE)
    exact = motion.exact(times)
    assert getattr(run, motion.signal) == pytest.approx(exact, abs=1e-7 * np.abs(exact).max())
    assert run.event_times == pytest.approx(motion.event_times, abs=1e-7)
    assert run.sticks == motion.sticks


def test_it_breaks_loose_when_friction_gives_way() -> None:
    times = np.linspace(0.0, 1e-3, 21)
    run = simulate(FIRST_SLIP.device, [HeldInputs(0.0, 1e-3)], times, tolerance=TOLERANCE)
    assert run.event_times[0] == pytest.approx(FIRST_SLIP.event_times[0], rel=1e-9)
    assert run.velocity == pytest.approx(FIRST_SLIP.exact(times), abs=1e-9)


@pytest.mark.parametrize("parameters", [{}, {"normal_amplitude": 2.0}, {"base_amplitude": 5e-8}])
def test_it_agrees_with_the_taylor_reference(parameters: dict[str, float]) -> None:
    device = Device.from_mapping(parameters)
    middle, stop = 2.3 * PERIOD, 6 * PERIOD
    held = [HeldInputs(0.0, middle, phase=0.4), HeldInputs(middle, stop, load=0.03)]
    times = np.linspace(0.0, stop, 49)
    run = simulate(device, held, times, tolerance=TOLERANCE)
    reference = taylor.simulate(device, held, times)
    for name in ("position", "velocity", "resonator_velocity"):
        expected = getattr(reference, name)
        error = np.abs(getattr(run, name) - expected).max()
        assert error < 1e-7 * np.abs(expected).max(), f"{name} off by {error}"
    assert run.event_times == pytest.approx(reference.event_times, abs=1e-6 * PERIOD)
    assert run.evaluations > 0
