"""An hour of simulated time in the native FMU, five minutes in the other: no drift, no leak."""

import math
from fractions import Fraction
from pathlib import Path

import pytest

from tests.fmu.host import Instance, Instantiate
from tests.fmu.native_layout import moment_of
from tests.fmus import both_fmus

TWO_PI = Fraction("6.28318530717958647692528676655900576839433879875021")
HOUR, FIVE_MINUTES = 3600, 300
W = 3500
RATIO = 1.37


def apart(phase: float, exact: Fraction) -> float:
    """Distance [rad] of a phase from an exact angle, on the circle."""
    return abs(math.remainder(float((Fraction(phase) - exact) % TWO_PI), math.tau))


def assert_phases(instance: Instance, seconds: int, allowed: float) -> None:
    moment = moment_of(instance.state())
    theta, psi = Fraction(W * seconds), Fraction(RATIO) * W * seconds
    assert apart(moment["theta"], theta) < allowed, "the drive phase is w t modulo a turn"
    assert apart(moment["psi"], psi) < allowed, "that of the normal load is ratio w t"


def resident_kilobytes() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4


@pytest.mark.slow
@both_fmus
def test_a_long_run(instantiate: Instantiate, fmu: Path) -> None:
    instance = instantiate().initialize(frequency_ratio=RATIO)
    settled, seconds = 0, HOUR if fmu.stem == "SliderResonator" else FIVE_MINUTES
    for k in range(2 * seconds):
        instance.slave.doStep(currentCommunicationPoint=0.5 * k, communicationStepSize=0.5)
        if k == 200:
            settled = resident_kilobytes()
    growth = resident_kilobytes() - settled
    assert_phases(instance, seconds, 1e-6)
    assert growth < 512, f"memory grew by {growth} kB in {seconds} s of simulated time"


@both_fmus
def test_one_long_step_keeps_the_phase(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(frequency_ratio=RATIO)
    instance.step(20.0)
    assert_phases(instance, 20, 1e-9)
