"""An hour of simulated time in the native FMU, five minutes in the other: no drift, no leak."""

import math
from fractions import Fraction
from pathlib import Path

import pytest

from tests.fmu.host import Instance, Instantiate
from tests.fmu.native_layout import moment_of
from tests.fmus import both_fmus

TWO_PI = Fraction("6.28318530717958647692528676655900576839433879875021")
W = 3500
RATIO = 1.37


def assert_phases(instance: Instance, seconds: int, allowed: float) -> None:
    """The phases of drive and normal load are w t and ratio w t, up to an angle in rad."""
    moment = moment_of(instance.state())
    for name, exact in (("theta", Fraction(W * seconds)), ("psi", Fraction(RATIO) * W * seconds)):
        turned = float((Fraction(moment[name]) - exact) % TWO_PI)
        assert abs(math.remainder(turned, math.tau)) < allowed, name


def resident_kilobytes() -> int:
    return int(Path("/proc/self/statm").read_text().split()[1]) * 4


@pytest.mark.slow
@both_fmus
def test_a_long_run(instantiate: Instantiate, fmu: Path) -> None:
    instance = instantiate().initialize(frequency_ratio=RATIO)
    settled, seconds = 0, 3600 if fmu.stem == "SliderResonator" else 300
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
