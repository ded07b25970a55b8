from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from slider_resonator.device.device import Device
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.simulate import simulate
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.trading.peers import located_scipy
from tests.harness.references.comparing import assert_agree
from tests.problems import DURATION, PROBLEMS

TIMES = np.linspace(0.0, DURATION, 1501)
QUICK = ("table 1", "lift-off with sticking", "undamped, sticking resonance")
ALL = pytest.mark.parametrize(
    "name",
    [pytest.param(name, marks=() if name in QUICK else pytest.mark.slow) for name in PROBLEMS],
)


@cache
def run(name: str) -> Trajectory:
    problem = PROBLEMS[name]
    return simulate(problem.device, problem.held, TIMES)


@ALL
def test_scipy_with_located_events_agrees(name: str) -> None:
    problem = PROBLEMS[name]
    changes = len(problem.held) > 1
    held = problem.held if changes else [replace(problem.held[0], stop=0.06)]
    times = np.linspace(0.0, held[-1].stop, 501)
    exact = simulate(problem.device, held, times)
    other = located_scipy.simulate(problem.device, held, times)
    assert_agree(exact, other, allowed=3e-9)
    assert other.event_times == pytest.approx(exact.event_times, rel=1e-10, abs=1e-14)


def _between(least: float, greatest: float) -> st.SearchStrategy[float]:
    return st.floats(least, greatest, allow_subnormal=False)


@pytest.mark.slow
@settings(max_examples=60)
@given(
    parameters=st.fixed_dictionaries(
        {
            "slider_mass": _between(0.01, 2.0),
            "resonator_mass": _between(0.001, 0.5),
            "resonator_frequency": _between(300.0, 9000.0),
            "damping_ratio": _between(0.0, 2.0),
            "normal_amplitude": _between(0.0, 3.0),
            "base_amplitude": _between(-9.0, -4.0).map(lambda power: 10.0**power),
            "tangential_force": st.one_of(_between(-1.0, -0.01), _between(0.01, 1.0)),
            "friction_coefficient": _between(0.05, 0.8),
            "fidelity": st.sampled_from([1, 2]),
            # From rest a release can fall within rounding of its limit, where counts are open.
            "initial_velocity": st.one_of(_between(-0.1, -0.01), _between(0.01, 0.1)),
        }
    ),
    inputs=st.lists(
        st.tuples(_between(0.001, 0.01), _between(-4, 4), _between(-0.3, 0.3), _between(-8, 8)),
        min_size=1,
        max_size=4,
    ),
)
def test_random_devices_agree_with_scipy(
    parameters: dict[str, float], inputs: list[tuple[float, float, float, float]]
) -> None:
    stops = np.cumsum([duration for duration, *_ in inputs]).tolist()
    held = [
        HeldInputs(start, stop, *values)
        for start, stop, (_, *values) in zip([0.0, *stops[:-1]], stops, inputs, strict=True)
    ]
    device = Device.from_mapping(parameters)
    times = np.linspace(0.0, stops[-1], 101)
    exact = simulate(device, held, times)
    assert_agree(exact, located_scipy.simulate(device, held, times), allowed=1e-7)
