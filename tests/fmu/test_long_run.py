"""An hour of simulated time, two million drive periods: no drift of phase, no growth of memory."""

from __future__ import annotations

import math
from fractions import Fraction
from pathlib import Path

import pytest

from tests.fmu.host import Instance, Instantiate
from tests.fmu.native_layout import moment_of
from tests.fmus import both_fmus

TWO_PI = Fraction("6.28318530717958647692528676655900576839433879875021")
HOUR = 3600
W = 3500
RATIO = 1.37


def phases(instance: Instance) -> tuple[float, float]:
    moment = moment_of(instance.state())
    return moment["theta"], moment["psi"]


def apart(phase: float, exact: Fraction) -> float:
    """Distance [rad] of a phase from an exact angle, on the circle."""
    return abs(math.remainder(float((Fraction(phase) - exact) % TWO_PI), math.tau))


def resident_kilobytes() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4


@pytest.mark.slow
@both_fmus
def test_an_hour(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(frequency_ratio=RATIO)
    settled = 0
    for k in range(2 * HOUR):
        instance.slave.doStep(currentCommunicationPoint=0.5 * k, communicationStepSize=0.5)
        if k == 200:
            settled = resident_kilobytes()
    growth = resident_kilobytes() - settled
    theta, psi = phases(instance)
    assert apart(theta, Fraction(W * HOUR)) < 1e-6, "the drive phase drifted"
    assert apart(psi, Fraction(RATIO) * W * HOUR) < 1e-6, "the phase of the normal load drifted"
    assert growth < 512, f"memory grew by {growth} kB in an hour of simulated time"


@both_fmus
def test_one_long_step_keeps_the_phase(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(frequency_ratio=RATIO)
    instance.step(20.0)
    theta, psi = phases(instance)
    assert apart(theta, Fraction(W * 20)) < 1e-9, "the drive phase is w t modulo a turn"
    assert apart(psi, Fraction(RATIO) * W * 20) < 1e-9, "that of the normal load is ratio w t"
