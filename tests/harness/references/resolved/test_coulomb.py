from dataclasses import replace

import numpy as np
import pytest

from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.trading.peers import located_scipy
from tests.harness.references.comparing import assert_agree
from tests.problems import PROBLEMS

QUICK = ("table 1", "lift-off with sticking", "undamped, sticking resonance")


@pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in PROBLEMS],
)
def test_scipy_with_located_events_agrees(name: str) -> None:
    problem = PROBLEMS[name]
    changes = len(problem.held) > 1
    held = problem.held if changes else [replace(problem.held[0], stop=0.06)]
    times = np.linspace(0.0, held[-1].stop, 501)
    exact = simulate(problem.device, held, times)
    other = located_scipy.simulate(problem.device, held, times)
    assert_agree(exact, other, allowed=3e-9)
    assert other.event_times == pytest.approx(exact.event_times, rel=1e-10, abs=1e-14)


def test_slips_within_a_long_step_are_found() -> None:
    """Of a soft resonator the slider reverses twice in a quarter of the fastest period."""
    problem = PROBLEMS["soft resonator"]
    held, times = [replace(problem.held[0], stop=0.03)], np.linspace(0.0, 0.03, 101)
    exact = simulate(problem.device, held, times)
    long_steps = {"rtol": 1e-8, "atol": 1e-10, "steps_per_period": 4}
    other = located_scipy.simulate(problem.device, held, times, **long_steps)  # type: ignore[arg-type]
    assert len(other.event_times) == len(exact.event_times)
