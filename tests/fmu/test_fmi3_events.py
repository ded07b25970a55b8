"""Early return of FMI 3.0 at located events: every one of them, exactly, and without an effect."""

import math
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from studies.hosts.job import HostAnswer
from studies.hosts.runs import compare
from tests.fmu.host import OUTPUTS, Unpacked
from tests.fmu.host_3 import Run, instance_3

PERIOD = math.tau / 3500.0
PERIODS = 200
LIFTED = 2.0

STICK_SLIP = {"base_amplitude": 0.0, "load": 0.1}
FLIGHT = {"normal_amplitude": 1.8, "friction_coefficient": 1.0, "phase": 0.7}
LUGRE = {"friction_law": 1.0}
DEVICES: dict[str, dict[str, float]] = {
    "table 1": {},
    "table 1, one degree of freedom": {"fidelity": 1},
    "table 1, LuGre": LUGRE,
    "table 1, stiff bristles": {**LUGRE, "bristle_stiffness": 1e12, "tolerance": 1e-12},
    "stick-slip": STICK_SLIP,
    "flight": FLIGHT,
    "flight, LuGre": {**LUGRE, **FLIGHT},
    "presliding": {**LUGRE, "base_amplitude": 1e-6, "initial_resonator_displacement": 1e-5},
}


def run(
    unpacked: Unpacked, values: dict[str, float], steps: int, size: float, *, events: bool = True
) -> Run:
    with instance_3(unpacked, event_mode=events, early_return=events) as instance:
        return instance.initialize(**values).run(steps, size)


@pytest.mark.parametrize("device", DEVICES)
def test_every_reversal_ends_a_step(unpacked_3: Unpacked, device: str) -> None:
    values = DEVICES[device]
    stopping = run(unpacked_3, values, PERIODS, PERIOD)
    passing = run(unpacked_3, values, PERIODS, PERIOD, events=False)
    assert passing.events == []
    last = dict(zip(OUTPUTS, passing.rows[-1], strict=True))
    column = OUTPUTS.index("velocity")
    peak = max(abs(row[column]) for row in passing.rows)
    # Each reversal is counted by the step that begins there: between its event and the next one.
    counts = [event.outputs["reversals"] for event in stopping.events]
    assert counts[0] == 0.0
    counts.append(last["reversals"])
    modes = [event.outputs["contact_mode"] for event in stopping.events]
    for index, (before, after) in enumerate(pairwise(counts)):
        assert after - before in (0.0, 1.0), "two reversals, one event"
        touches_down = index > 0 and modes[index - 1] == LIFTED != modes[index]
        if after > before and not touches_down:
            assert abs(stopping.events[index].outputs["velocity"]) <= 1e-14 * peak
    expected, found = ([[*row] for row in one.rows] for one in (passing, stopping))
    deviation = compare(expected, HostAnswer(found)).deviation
    assert deviation is not None
    assert deviation <= 1e-12


@pytest.mark.parametrize("device", ["table 1", "table 1, LuGre", "stick-slip", "flight"])
@pytest.mark.parametrize("ulps", [-2, -1, 0, 1, 2])
def test_steps_that_end_at_events_miss_none(unpacked_3: Unpacked, device: str, ulps: int) -> None:
    """The end of a step beside an event: found in this step or in the next one, and once."""
    values = DEVICES[device]
    times = [event.time for event in run(unpacked_3, values, 1, 30 * PERIOD).events]
    found: list[float] = []
    with instance_3(unpacked_3) as instance:
        instance.initialize(**values)
        for time in [*(t + ulps * math.ulp(t) for t in times), 30 * PERIOD]:
            found += [event.time for event in instance.step_to(time)]
    assert found == pytest.approx(times, rel=1e-11)


@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(steps=st.lists(st.floats(1e-7, 4e-3), min_size=1, max_size=8))
def test_a_state_goes_on_as_the_instance(unpacked_3: Unpacked, steps: list[float]) -> None:
    """It keeps the rounding error of the time."""
    with instance_3(unpacked_3) as one, instance_3(unpacked_3) as other:
        one.initialize(phase=0.3, load=0.02)
        assert one.step_to(1e-3), "it has passed events"
        other.restore(one.state())
        other.time = one.time
        for size in steps:
            assert one.step_to(one.time + size) == other.step_to(other.time + size)
        assert one.state() == other.state(), "to the last bit"


devices = st.fixed_dictionaries(
    {
        "friction_law": st.sampled_from([0, 1]),
        "fidelity": st.sampled_from([1, 2]),
        "friction_coefficient": st.floats(0.01, 5.0),
        "normal_amplitude": st.floats(0.0, 2.5),
        "base_amplitude": st.floats(0.0, 3e-4),
        "frequency_ratio": st.sampled_from([0.0, 1.0, -1.0, 2.0, 3.0, 1.37]),
        "phase": st.floats(-3.0, 3.0),
        "load": st.floats(-0.5, 0.5),
        "initial_velocity": st.floats(-0.3, 0.3),
    }
)


@settings(max_examples=30, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(values=devices, steps=st.integers(1, 30))
@example(values={**STICK_SLIP, "normal_amplitude": 1.0}, steps=7)
def test_stopping_at_events_does_not_change_the_motion(
    unpacked_3: Unpacked, values: dict[str, float], steps: int
) -> None:
    size = 10 * PERIOD / steps
    stopping = run(unpacked_3, values, steps, size)
    passing = run(unpacked_3, values, steps, size, events=False)
    names = ("position", "velocity", "resonator_displacement", "reversals")
    columns = [OUTPUTS.index(name) for name in names]
    found, expected = (np.array(r.rows)[:, columns] for r in (stopping, passing))
    scale = np.maximum(np.abs(expected).max(axis=0), 1e-7)
    assert np.abs(found - expected) / scale == pytest.approx(0.0, abs=1e-9)
    reversals = found[-1, -1]
    assert reversals <= len(stopping.events), "no reversal without an event"
    times = [event.time for event in stopping.events]
    assert times == sorted(times)
