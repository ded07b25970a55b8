"""The velocity controller, run alone: its law, its samples, what it refuses, its state."""

from math import asin, nan

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


def test_refused_values_and_steps_change_nothing(instantiate: Instantiate) -> None:
    """Those that the functions shared with the slider do not refuse there, too."""
    instance = instantiate()
    with instance.refuses("reading phase refused in state 'instantiated'"):
        instance.get("phase")
    instance.initialize(velocity_reference=0.01).step(SAMPLE)
    for values, text in (
        ({"measured_velocity": nan}, "measured_velocity = nan refused: must be a finite number"),
        ({"effort_limit": 1.5}, "effort_limit = 1.5 refused: must be a finite number from 0 to 1"),
        ({"sample_time": 0.02}, "sample_time = 0.02 refused: it is fixed"),
        ({"phase": 0.1}, "phase = 0.1 refused: it is an output"),
    ):
        with instance.refuses(text):
            instance.set(**values)
    with instance.refuses("communicationStepSize = 1000000.0", "at most 1e+06 samples"):
        instance.step(1e6)
