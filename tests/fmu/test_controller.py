"""The velocity controller, run alone: its law, its samples, what it refuses, its state."""

from math import asin, nan, pi

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.fmu.host import Instantiate
from tests.fmus import controller_fmu_only

GAIN, INTEGRAL, THETA, SAMPLE = 100.0, 400.0, 0.733313, 0.01


pytestmark = controller_fmu_only


class Law:
    """The law once more: velocity errors in, effort out."""

    def __init__(self) -> None:
        self.integral = 0.0

    def effort(self, error: float) -> float:
        unlimited = GAIN * error + self.integral
        effort = max(-1.0, min(1.0, unlimited))
        if effort == unlimited or unlimited * error < 0.0:
            self.integral = max(-1.0, min(1.0, self.integral + INTEGRAL * SAMPLE * error))
        return effort


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.floats(-0.05, 0.05), min_size=1, max_size=60))
def test_effort_and_phase_follow_the_law(instantiate: Instantiate, errors: list[float]) -> None:
    law = Law()
    instance = instantiate()
    instance.initialize(velocity_reference=0.06)
    for error in errors:
        measured = 0.06 - error
        instance.set(measured_velocity=measured)
        instance.step(SAMPLE)
        expected = law.effort(0.06 - measured)
        effort, phase = instance.get("effort", "phase")
        assert effort == pytest.approx(expected, abs=1e-12)
        assert phase == pytest.approx(asin(expected) - THETA, abs=1e-6)


def test_the_integral_does_not_wind_up(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(velocity_reference=0.06)
    for _ in range(1000):
        instance.step(SAMPLE)
    assert instance.get("effort", "phase") == pytest.approx((1.0, pi / 2 - THETA)), "at its limit"
    instance.set(measured_velocity=0.061)
    instance.step(SAMPLE)
    (effort,) = instance.get("effort")
    assert effort == pytest.approx(-0.1), "ten seconds at the limit have left nothing behind"


@pytest.mark.parametrize("parts", [1, 4, 10])
@pytest.mark.parametrize("samples", [1, 20])
def test_samples_do_not_depend_on_the_communication_step(
    instantiate: Instantiate, parts: int, samples: int
) -> None:
    """Twenty samples in all, of which `samples` fall due in `parts` steps."""
    instance = instantiate().initialize(start_time=3.0, velocity_reference=0.001)
    law = Law()
    for _ in range(20 // samples):
        for _ in range(parts):
            instance.step(samples * SAMPLE / parts)
        expected = [law.effort(0.001) for _ in range(samples)]
        assert instance.get("effort") == pytest.approx((expected[-1],), abs=1e-12)


def test_a_replayed_state_gives_the_same_bits(instantiate: Instantiate) -> None:
    first, other = instantiate().initialize(velocity_reference=0.03), instantiate().initialize()
    first.step(0.025)
    other.restore(first.state())
    other.time = first.time
    for instance in (first, other):
        instance.set(measured_velocity=0.0287)
        instance.step(0.013)
    assert first.state() == other.state()
    assert first.get("phase", "effort") == other.get("phase", "effort")


def test_damaged_states_are_refused(instantiate: Instantiate) -> None:
    instance = instantiate().initialize()
    state = instance.state()
    for place in (0, 45, len(state) - 1):
        damaged = state[:place] + bytes([state[place] ^ 1]) + state[place + 1 :]
        with instance.refuses("FMU state refused"):
            instance.restore(damaged)
    with instance.refuses("FMU state refused"):
        instance.restore(state[:-8])


def test_refused_values_and_steps_change_nothing(instantiate: Instantiate) -> None:
    instance = instantiate().initialize(velocity_reference=0.01)
    instance.step(SAMPLE)
    with instance.refuses("measured_velocity = nan refused: must be a finite number"):
        instance.set(measured_velocity=nan)
    with instance.refuses("effort_limit = 1.5 refused: must be a finite number from 0 to 1"):
        instance.set(effort_limit=1.5)
    with instance.refuses("sample_time = 0.02 refused: it is fixed"):
        instance.set(sample_time=0.02)
    with instance.refuses("phase = 0.1 refused: it is an output"):
        instance.set(phase=0.1)
    for size in (0.0, -1.0, nan):
        with instance.refuses("communicationStepSize", "must be a finite number above 0"):
            instance.step(size)
        instance.time = SAMPLE
    with instance.refuses("currentCommunicationPoint = 7.0 refused: must be the present time"):
        instance.slave.doStep(currentCommunicationPoint=7.0, communicationStepSize=SAMPLE)
    with instance.refuses("communicationStepSize = 1000000.0", "at most 1e+06 samples"):
        instance.step(1e6)


def test_calls_out_of_order_are_refused(instantiate: Instantiate) -> None:
    instance = instantiate()
    with instance.refuses("doStep refused in state 'instantiated'"):
        instance.step(SAMPLE)
    with instance.refuses("reading phase refused in state 'instantiated'"):
        instance.get("phase")
    with instance.refuses("stopTime = -1.0 refused"):
        instance.slave.setupExperiment(startTime=0.0, stopTime=-1.0)
    with instance.refuses("tolerance = -1.0 refused"):
        instance.slave.setupExperiment(startTime=0.0, tolerance=-1.0)
