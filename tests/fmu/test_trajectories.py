"""The built FMU against the Taylor reference: every signal, and the counts of events."""

from __future__ import annotations

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from numpy.typing import NDArray

from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
from tests.fmu.host import Instantiate, Unpacked
from tests.fmu.trajectories import assert_equal, fmu_run
from tests.fmus import both_fmus
from tests.problems import DURATION, PROBLEMS, SIGNALS, STEADY_VELOCITIES, Problem

pytestmark = both_fmus

ALLOWED = 1e-9
"""Deviation allowed, as a fraction of the peak of each signal."""


@cache
def reference_of(name: str, count: int) -> Trajectory:
    """The reference at the same moments, for both FMUs."""
    problem = PROBLEMS[name]
    return simulate(problem.device, problem.held, grid(problem, count))


def grid(problem: Problem, count: int) -> NDArray[np.float64]:
    starts = [start for start, _ in problem.pieces[1:]]
    return np.union1d(np.linspace(0.0, DURATION, count + 1)[1:], starts)


@pytest.mark.parametrize("name", PROBLEMS)
def test_motion_is_that_of_the_reference(instantiate: Instantiate, name: str) -> None:
    problem = PROBLEMS[name]
    signals, ends = fmu_run(instantiate, problem, grid(problem, 230))
    reference = reference_of(name, 230)
    assert_equal(signals, reference, ALLOWED)
    assert ends["reversals"] == reference.reversals, "reversals seen by the reference"
    assert ends["sticks"] == reference.sticks, "sticks seen by the reference"
    assert ends["contact_mode"] == reference.contact_mode[-1], "the contact at the end"
    if reference.event_times.size:
        assert ends["last_event_time"] == pytest.approx(reference.event_times[-1], abs=1e-12)


@pytest.mark.parametrize("name", ["table 1", "sticking every period", "lift-off with sticking"])
@pytest.mark.parametrize("count", [1, 7, 1000])
def test_independent_of_the_partition(instantiate: Instantiate, name: str, count: int) -> None:
    problem = PROBLEMS[name]
    signals, ends = fmu_run(instantiate, problem, grid(problem, count))
    reference = reference_of(name, 1)
    expected = [getattr(reference, signal)[-1] for signal in SIGNALS[:4]]
    assert signals[-1, :4] == pytest.approx(expected, rel=1e-9, abs=1e-13)
    assert ends["reversals"] == reference.reversals, "no partition hides or adds a reversal"


@pytest.mark.parametrize(("ratio", "phase"), STEADY_VELOCITIES)
def test_steady_velocity_is_that_of_another_program(
    instantiate: Instantiate, ratio: int, phase: float
) -> None:
    scale = 2.0 / 11.0  # x0 w0 of table 1, m/s
    instance = instantiate().initialize(frequency_ratio=ratio, phase=phase)
    expected = STEADY_VELOCITIES[ratio, phase] * scale
    assert instance.get("steady_velocity") == pytest.approx((expected,), abs=2e-4 * scale)


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["table 1", "sticking every period", "undamped, slipping resonance"]
)
def test_steps_of_two_microseconds(instantiate: Instantiate, unpacked: Unpacked, name: str) -> None:
    """A tenth of them with the Python FMU, whose steps take longer and round as the native ones."""
    problem = PROBLEMS[name]
    share = 1 if unpacked.description.modelName == "SliderResonator" else 10
    times = 2e-6 * np.arange(1.0, 100_000 // share + 1)
    instance = instantiate().initialize(**problem.parameters)
    rows = []
    for i, time in enumerate(times):
        instance.slave.doStep(currentCommunicationPoint=time - 2e-6, communicationStepSize=2e-6)
        if (i + 1) % 500 == 0:
            rows.append(instance.get(*SIGNALS))
    reference = simulate(
        problem.device, [replace(problem.held[0], stop=float(times[-1]))], times[499::500]
    )
    assert_equal(np.array(rows), reference, ALLOWED)
    assert instance.get("reversals")[0] == reference.reversals, "reversals seen by the reference"
