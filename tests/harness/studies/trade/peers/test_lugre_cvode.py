"""CVODE on LuGre friction: its error falls with its tolerance."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.lugre_taylor import simulate_lugre
from slider_resonator.studies.trade.peers.lugre_cvode import simulate_lugre_cvode

DEVICE = Device(friction_law=1, bristle_stiffness=1e4, initial_velocity=-0.0491)
HELD = HeldInputs(0.0, 4.0 * math.pi / DEVICE.drive_frequency, phase=0.3, load=0.02)


def test_error_falls_with_tolerance() -> None:
    def velocity_at_stop(tolerance: float) -> float:
        run = simulate_lugre_cvode(DEVICE, HELD, np.array([HELD.stop]), tolerance=tolerance)
        return float(run.samples[-1, 1])

    reference = simulate_lugre(DEVICE, [HELD], np.array([0.0, HELD.stop]))
    errors = [abs(velocity_at_stop(t) - reference.velocity[-1]) for t in (1e-5, 1e-9)]
    assert errors[0] < 1e-3
    assert errors[1] < 1e-2 * errors[0] or errors[1] < 1e-8


def test_states_at_the_times_asked_for() -> None:
    times = np.linspace(0.0, HELD.stop, 5)
    run = simulate_lugre_cvode(DEVICE, HELD, times, tolerance=1e-9)
    reference = simulate_lugre(DEVICE, [HELD], times)
    assert run.samples[:, 1] == pytest.approx(reference.velocity, abs=1e-5)
    assert run.evaluations > 0


def test_other_devices_are_refused() -> None:
    with pytest.raises(ValueError, match="LuGre friction"):
        simulate_lugre_cvode(replace(DEVICE, friction_law=0), HELD, np.empty(0), tolerance=1e-6)
