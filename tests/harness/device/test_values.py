"""Values of variables, and signals and schedules of inputs."""

from collections.abc import Callable
from dataclasses import replace
from math import inf, nan, pi
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.device.device import Device
from slider_resonator.device.drive_periods import common_period
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.device.interface import INPUT_STARTS, INPUTS, PARAMETERS, VARIABLES
from slider_resonator.device.schedule import communication_points, schedule, step_count
from slider_resonator.device.signal import Signal, constant, through
from slider_resonator.device.variable import Variable
from slider_resonator.fmu.opening import Fmu


@pytest.mark.parametrize(
    ("name", "value", "said"),
    [
        ("load", np.float32(inf), "load = inf: must be a finite number"),
        ("load", 10**400, "load = 1000"),
        ("friction_law", 10**400, "must be an integer from 0 to"),
        ("fidelity", inf, "fidelity = inf: must be an integer"),
        ("fidelity", 2.0**32 + 2, "must be an integer from 0 to"),
        ("tolerance", 0.1, "tolerance = 0.1: must be a finite number from 1e-14 to 0.01"),
        ("drive_frequency", "20 khz", "unknown unit 'khz'"),
        (
            "slider_mass",
            "50 gr",
            "slider_mass = '50 gr': unknown unit 'gr'; must be a number in kg, or",
        ),
        ("load", "9**9**9 N", "load = '9**9**9 N': must be a number in N, or a text with a unit"),
        ("load", "", "load = '': must be a number in N, or a text with a unit such as '1 mN'"),
        ("load", "1 N^2", "load = '1 N^2': not in N"),
        ("load", "__import__('os')", "such as '1 mN'"),
    ],
)
def test_invalid_value_is_refused_by_name(name: str, value: Any, said: str) -> None:
    """Others are among the mistakes in files and in commands."""
    variable = VARIABLES[name]
    with pytest.raises(ValueError, match=name) as error:
        variable.read(value)
    assert said in str(error.value)


@pytest.mark.parametrize("variable", [VARIABLES[name] for name in (*PARAMETERS, *INPUTS)])
def test_bounds_are_inclusive(variable: Variable) -> None:
    bounds = (variable.minimum, variable.maximum)
    for value in (-1e300 if bounds[0] is None else bounds[0], variable.start):
        assert value is not None
        variable.read(value)
    if bounds[1] is not None:
        variable.read(bounds[1])
    elif variable.kind == "Real":
        variable.read(1e300)


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("drive_frequency", "20 kHz", 2.0 * pi * 20e3),
        ("drive_frequency", "3000 rpm", 2.0 * pi * 50.0),
        ("base_amplitude", "1 um", 1e-6),
        ("base_amplitude", "1 µm", 1e-6),
        ("resonator_mass", "5 g", 5e-3),
        ("phase", "30 deg", pi / 6.0),
        ("load", "0.2N", 0.2),
        ("load", "0.2", 0.2),
        ("damping_ratio", "2 %", 0.02),
        ("bristle_stiffness", "0.1 1/um", 1e5),
        ("bristle_damping", "0.01 s/mm", 10.0),
        ("initial_velocity", "-3 mm/s", -3e-3),
        ("load", "1e-3", 1e-3),
    ],
)
def test_text_becomes_si(name: str, text: str, value: float) -> None:
    assert VARIABLES[name].in_si(text) == pytest.approx(value, rel=1e-14)


REAL = [name for name in sorted(PARAMETERS) if VARIABLES[name].kind == "Real"]


@given(st.sampled_from(REAL), st.floats(1e-9, 1e9))
def test_what_is_shown_is_read_back(name: str, value: float) -> None:
    assert VARIABLES[name].in_si(VARIABLES[name].shown(value)) == pytest.approx(value, rel=1e-5)


def test_fmu_has_this_interface_and_these_starts(fmu: Fmu) -> None:
    """The interface is written down twice, in the harness and in the component: both must agree."""
    assert fmu.variables.keys() <= VARIABLES.keys()
    starts = {**vars(Device()), **INPUT_STARTS}
    for name in starts.keys() & fmu.variables.keys():
        start = starts[name]
        assert float(fmu.variables[name].start) == start, name


def test_a_drive_may_deviate_beyond_what_a_parameter_can_say() -> None:
    slow = Device.from_mapping({"drive_frequency": 1e-5, "frequency_deviation": -0.95})
    assert slow.tuned([("fidelity", 1)]).drive_frequency == pytest.approx(5e-7)


def test_steps_hold_until_the_next_point() -> None:
    signal = through([(0.0, 1.0), (0.5, 2.0)])
    assert [signal.at(t) for t in (-1.0, 0.0, 0.4999, 0.5, 9.0)] == [1.0, 1.0, 1.0, 2.0, 2.0]
    assert signal.jumps == (0.5,)


def test_sizes_of_steps_follow_each_other_and_the_last_step_ends_at_the_stop() -> None:
    times = communication_points(1.0, (0.1, 0.3), jumps=[0.45])
    assert times == pytest.approx([0.0, 0.1, 0.4, 0.45, 0.5, 0.8, 0.9, 1.0])
    assert step_count(1.0, (0.1, 0.3)) == 6, "as many as whole rounds have"


def test_a_tuned_parameter_parts_the_inputs() -> None:
    plan = schedule(
        1.0,
        0.25,
        {"normal_preload": through([(0.0, 1.0), (0.3, 2.0)])},
        load=through([(0.0, 0.1), (0.5, 0.2)]),
    )
    assert plan.times.tolist() == [0.0, 0.25, 0.3, 0.5, 0.75, 1.0]
    assert plan.changes.tolist() == [2, 3]
    assert plan.readings().tolist() == plan.times.tolist(), "read once unless it is asked"
    held = plan.held()
    assert [(h.start, h.load, Device().tuned(h.tuned).normal_preload) for h in held] == [
        (0.0, 0.1, 1.0),
        (0.3, 0.1, 2.0),
        (0.5, 0.2, 2.0),
    ]
    assert Device(slider_mass=3.0).tuned(held[1].tuned) == Device(
        slider_mass=3.0, normal_preload=2.0
    )
    assert Device().tuned(HeldInputs(0.0, 1.0).tuned) == Device()


def test_outputs_are_read_before_and_after_a_change() -> None:
    plan = schedule(1.0, 0.5, load=through([(0.0, 0.1), (0.5, 0.2), (1.0, 0.3)]))
    plan = replace(plan, reads_twice=True)
    before, after = 0.5, float(np.nextafter(0.5, 1.0))
    assert plan.readings().tolist() == [0.0, before, after, 1.0], "nothing is set at the stop"
    finer = plan.read_at(np.linspace(0.5, 1.0, 3), 0.0025)
    assert (finer.reads_twice, finer.readings().tolist()) == (True, [0, before, after, 0.75, 1.0])


@given(
    st.lists(st.tuples(st.floats(0, 10), st.floats(-1e3, 1e3)), min_size=1, max_size=6),
    st.lists(st.floats(-1, 12), min_size=1, max_size=20),
    st.booleans(),
)
def test_values_in_time(points: list[tuple[float, float]], times: list[float], hold: bool) -> None:
    ascending = sorted(dict(points).items())
    signal = through(ascending, hold=hold)
    asked = np.array(sorted([*times, *signal.times]))
    assert signal.over(asked).tolist() == [signal.at(time) for time in asked.tolist()]


@given(
    stop=st.floats(0.1, 10.0),
    step=st.floats(0.01, 3.0),
    jumps=st.lists(st.floats(0.0, 10.0), max_size=5),
)
def test_every_jump_is_a_communication_point(stop: float, step: float, jumps: list[float]) -> None:
    points = communication_points(stop, step, jumps)
    assert points[0] == 0.0
    assert points[-1] == stop
    assert np.all(np.diff(points) > 0.0)
    assert np.max(np.diff(points)) <= step * (1.0 + 1e-6)
    assert {t for t in jumps if 0.0 < t < stop} <= set(points.tolist())


def test_jump_replaces_a_grid_point_just_before_it() -> None:
    """Otherwise a whole step, or a sliver of one, would hold the old value."""
    jump = 0.3 * (1.0 + 1e-12)
    made = schedule(1.0, 0.1, load=through([(0.0, 0.0), (jump, 5.0)]))
    assert len(made.times) == 11
    assert jump in made.times
    assert made.sampled[3, 1] == 5.0


def test_extra_readings_keep_the_held_inputs() -> None:
    plan = schedule(
        1.0, 0.25, load=through([(0.0, 0.0), (1.0, 4.0)], hold=False), phase=constant(0.3)
    )
    more = plan.read_at(np.array([0.1, 0.25 + 1e-12, 0.6]), 1e-9)
    assert more.times.tolist() == [0.0, 0.1, 0.25, 0.5, 0.6, 0.75, 1.0]
    assert more.held() == plan.held()
    assert more.signals["phase"] is plan.signals["phase"], "what is constant stays so"


def test_lines_are_held_or_have_rates_and_corners() -> None:
    signals = {
        "load": through([(0.0, 0.0), (0.35, 0.7), (1.0, 0.7)], hold=False),
        "phase": through([(0.0, 0.2), (0.5, 0.7)]),
    }
    held, lines = (schedule(1.0, 0.1, None, line, **signals) for line in (False, True))
    assert not held.ramps
    assert lines.ramps
    assert 0.35 in lines.times
    assert 0.35 not in held.times
    rates = lines.rates
    inside = lines.times[:-1] < 0.35
    assert rates[:-1, 1] == pytest.approx(np.where(inside, 2.0, 0.0))
    assert not rates[:, [0, 2]].any(), "steps have no rate"
    *_, last = lines.held()
    assert (last.start, last.phase, last.load, last.load_rate) == (0.5, 0.7, 0.7, 0.0)
    finer = lines.read_at(np.arange(0.2, lines.times[-1], 0.01), 1e-4)
    assert np.allclose(finer.rates[:, 1], np.where(finer.times < 0.35 - 1e-9, 2.0, 0.0))


@pytest.mark.parametrize(
    ("call", "given", "message"),
    [
        (Signal, ((), ()), "at least one point"),
        (Signal, ((0.0, 1.0), (1.0, nan)), "finite"),
        (step_count, (0.0, 1.0), "must be above 0"),
        (step_count, (1.0, 0.0), "must be above 0"),
        (step_count, (nan, 1.0), "must be above 0"),
        (step_count, (1.0, (0.1, 0.0)), "must be above 0"),
    ],
)
def test_refusals(call: Callable[..., object], given: tuple[Any, ...], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        call(*given)


@pytest.mark.parametrize(
    ("ratio", "count"),
    [
        *((1.0, 1), (3.0, 1), (0.0, 1), (-1.0, 1), (1.5, 2), (1.0 / 3.0, 3), (-2.4, 5)),
        *((19.0 / 20.0, 20), (1.001, None), (2.0**0.5, None), (1.0 + 1e-9, None)),
    ],
)
def test_a_rational_ratio_repeats_after_its_denominator(ratio: float, count: int | None) -> None:
    assert common_period(ratio) == count
