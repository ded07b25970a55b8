"""CVODE on LuGre friction: its error falls with its tolerance."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.lugre_taylor import simulate_lugre
from slider_resonator.trade.peers.lugre_cvode import simulate_lugre_cvode

DEVICE = Device(friction_law=1, bristle_stiffness=1e4, initial_velocity=-0.0491)
HELD = HeldInputs(0.0, 4.0 * math.pi / DEVICE.drive_frequency, phase=0.3, load=0.02)


def test_error_falls_with_tolerance() -> None:
    times = np.linspace(0.0, HELD.stop, 5)
    reference = simulate_lugre(DEVICE, [HELD], times).velocity
    errors = []
    for tolerance in (1e-5, 1e-9):
        run = simulate_lugre_cvode(DEVICE, HELD, times, tolerance=tolerance)
        errors.append(np.abs(run.samples[:, 1] - reference).max())
        assert run.evaluations > 0
    assert errors[0] < 1e-3
    assert errors[1] < 1e-2 * errors[0] or errors[1] < 1e-8


def test_other_devices_are_refused() -> None:
    with pytest.raises(ValueError, match="LuGre friction"):
        simulate_lugre_cvode(replace(DEVICE, friction_law=0), HELD, np.empty(0), tolerance=1e-6)
