"""What is tried for a choice: steps, tolerances, their errors and cost, and inputs."""

from itertools import pairwise
from math import inf, log2, pi

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.arrays import Array
from slider_resonator.choosing import probe as probes
from slider_resonator.choosing.choice import Candidate
from slider_resonator.choosing.choosing import choose_with, coarsest
from slider_resonator.choosing.errors import ErrorEstimate, Readings, beat_frequency, unseen_beat
from slider_resonator.choosing.probe import Probe, exact_schedule, must_hold, steady_error
from slider_resonator.device.model import Model
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import Record
from slider_resonator.scenes.needs import AllowedTable
from slider_resonator.steady.searches import SteadyAnswer
from tests.harness.scene_text import scene_of


@given(st.integers(1, 30), st.floats(1e-8, 1e8))
def test_where_the_error_falls_the_coarsest_is_found(count: int, scale: float) -> None:
    found = coarsest(lambda index: scale * 2.0**-index, count)
    good = [index for index in range(count) if scale * 2.0**-index <= 1.0]
    assert found == (good[0] if good else None)


@given(st.lists(st.floats(0.0, 100.0), min_size=1, max_size=20))
def test_the_index_found_meets_the_need_and_no_coarser_does(errors: list[float]) -> None:
    found = coarsest(errors.__getitem__, len(errors))
    if found is not None:
        assert errors[found] <= 1.0
        assert all(error > 1.0 for error in errors[:found])


def test_an_error_that_does_not_fall_is_given_up_at_once() -> None:
    evaluation: list[int] = []

    def excess(index: int) -> float:
        evaluation.append(index)
        return 50.0

    assert coarsest(excess, 100) is None
    assert len(evaluation) == 3


def test_an_index_that_is_fine_enough_is_tried_before_the_search_gives_up() -> None:
    """Steps longer than an input takes to go up and down see none of it."""
    assert coarsest(lambda index: 3.0 if index < 7 else 0.5, 10, fine=8) == 7
    assert coarsest(lambda _: 3.0, 10, fine=8) is None


def test_a_candidate_that_cannot_run_is_refined() -> None:
    assert coarsest(lambda index: inf if index < 4 else 0.5, 10) == 4


PERIOD = 2.0 * pi / 3500.0
RAMP = "[inputs]\nload = { ramp = [[0, 0], [0.1, 0.1]] }\n"


def ladder(instance: Instance, text: str) -> tuple[float, ...]:
    steps = Probe(instance, scene_of(text)).ladder
    return tuple(step for step in steps if step is not None)


def test_inputs_that_vary_leave_powers_of_two_of_the_step(instance: Instance) -> None:
    run = f"{RAMP}[run]\nstop_time = 0.1\nstep_size = 0.003\n[need]\n"
    signal = ladder(instance, f"{run}position = {{ rel = 0.1 }}\n")
    number = ladder(instance, f"{run}mean_velocity = {{ rel = 0.1 }}\n")
    assert signal[0] == 0.003
    assert number[0] == 0.003 * 32
    assert number[-len(signal) :] == signal
    assert {log2(coarse / fine) for coarse, fine in pairwise(number)} == {1.0}
    assert PERIOD / 64 <= number[-1] < PERIOD / 32


def test_numbers_at_the_end_of_a_long_scene_are_tried_in_halves(instance: Instance) -> None:
    """An FMU bounds the work of a step."""
    run = "[run]\ndrive_periods = 70000\nsteps_per_period = 1\n[need]\n"
    steps = ladder(instance, f"{run}mean_velocity = {{ rel = 0.1 }}\n")
    assert [round(step / PERIOD) for step in steps] == [70_000, 35_000, 17_500, 8750]


RUN = "[run]\ndrive_periods = {}\nsteps_per_period = 0.01\n[need]\n{} = {{ rel = {} }}\n"
AVERAGED = Model(0, 0, 1)


@pytest.mark.usefixtures("stated_costs")
def test_steps_of_no_effect_are_joined(instance: Instance, monkeypatch: pytest.MonkeyPatch) -> None:
    text = RUN.format(4000, "position", 0.1).replace("0.01", "1")
    found = []
    for steps in (probes.MAX_STEPS, 100):
        monkeypatch.setattr(probes, "MAX_STEPS", steps)
        monkeypatch.setattr(probes, "TIMED_STEPS", steps)
        probe = Probe(instance, scene_of(text))
        found.append(probe.measure(Candidate(AVERAGED, 1e-8, probe.scene.step_size)))
    one, joined = (errors["position"].error for errors, _ in found)
    assert joined == pytest.approx(one, rel=0.1)
    assert found[1][1] == pytest.approx(found[0][1], rel=0.1), "all steps cost"


POINTS = np.linspace(0.1, 1.0, 10)
GRID = np.linspace(0.0, 1.0, 201)
TIMES = np.union1d(POINTS, GRID)
NAMES = ("position", "velocity", "mean_velocity", "reversals", "last_event_time")


def record(**signals: float | Array) -> Record:
    outputs = {name: np.zeros(TIMES.size) + signals.get(name, 0.0) for name in NAMES}
    return Record(TIMES, np.zeros((TIMES.size, 3)), outputs, 0.0, 0.0, 0.0)


def error(name: str, found: Record, reference: Record, law: int = 0) -> ErrorEstimate:
    readings = Readings({name: AllowedTable(rel=0.1)}, POINTS, GRID, 0.01, law)
    return readings.errors(found, reference)[name]


def test_signals_are_judged_everywhere_and_numbers_at_the_end() -> None:
    bump = np.where(TIMES < 0.35, 0.3, 0.0)
    reference = record(position=TIMES, mean_velocity=2.0)
    other = record(position=TIMES + bump, mean_velocity=2.0 + bump)
    position, velocity, throughout = (
        error(name, other, reference)
        for name in ("position", "mean_velocity", "mean_velocity_throughout")
    )
    assert (position.error, throughout.error) == pytest.approx((0.3, 0.3))
    assert position.magnitude == 1.0
    assert velocity.error < 1e-11
    assert velocity.magnitude == throughout.magnitude == 2.0


def test_events_are_the_nearest_true_ones() -> None:
    """Also where the one that a run shows is not yet, or no longer, the last of the reference."""
    events = 0.1 * np.floor(10.0 * TIMES) + 0.05
    late = np.maximum(0.1 * np.floor(10.0 * TIMES - 1.0), 0.0) + 0.05 + 1e-4
    reference = record(last_event_time=events)
    for found, expected in ((late, 1e-4), (events + 0.03, 0.03)):
        near = error("event_times", record(last_event_time=found), reference)
        assert near.error == pytest.approx(expected)
    missed = error("event_times", record(last_event_time=events, reversals=1), reference)
    assert missed.error == inf
    assert missed.reason == "1 reversal instead of 0"


def test_nothing_is_known_better_than_to_rounding() -> None:
    same = record(position=TIMES)
    for law, floor in ((0, 1e-12), (1, 1e-10)):
        assert error("position", same, same, law).error == floor


@pytest.mark.parametrize(
    ("found", "shown"), [(1.0, True), (1.15, True), (2.1, True), (0.1, False), (1.5, False)]
)
def test_strongest_oscillation_is_the_beat_or_a_multiple(found: float, shown: bool) -> None:
    beat = beat_frequency(scene_of("[inputs]\nfrequency_ratio = 1.02\n"))
    assert beat == pytest.approx(0.02 * 3500.0 / (2.0 * pi))
    reason = unseen_beat(ErrorEstimate(0.0, found * beat), beat)
    assert (reason == "") == shown
    assert shown or f"strongest oscillation has {found * beat:.4g} Hz" in reason


def test_a_slow_motion_that_does_not_beat_has_no_beat(instance: Instance) -> None:
    """Without a vibrating load only the drift of the start is left in the mean velocity."""
    scene = scene_of(
        "[device]\nnormal_amplitude = 0.0\ninitial_velocity = 0.1\n"
        "[inputs]\nfrequency_ratio = 1.01\n"
        "[run]\ndrive_periods = 1000\nsteps_per_period = 1\n[need]\nbeat = { rel = 1e-2 }\n"
    )
    choice = choose_with(instance, scene)
    assert not choice.meets
    assert "in the resolved run" in choice.reason


RAMPED = scene_of(
    "[inputs]\nload = { ramp = [[0, 0], [0.03, 0.3], [0.1, 0]] }\n"
    "phase = { steps = [[0, 0.2], [0.051, 0.7]] }\n"
    "frequency_ratio = { ramp = [[0, 1], [0.05, 1.5]] }\n"
    "[run]\nstop_time = 0.1\nstep_size = 0.007\n"
)
ENDS = np.array([0.0, 0.1])


@pytest.mark.parametrize("step", [0.011, 0.002])
def test_held_inputs_give_their_impulse_exactly(step: float) -> None:
    schedule = exact_schedule(RAMPED, ENDS, step, interpolates=False)
    assert not schedule.ramps
    load, ratio = (np.diff(schedule.times) @ schedule.sampled[:-1, i] for i in (1, 2))
    assert load == pytest.approx(0.5 * 0.3 * 0.1, rel=1e-12)
    assert ratio == pytest.approx(0.05 * 1.25 + 0.05 * 1.5, rel=1e-12)


def test_lines_that_are_passed_on_need_their_corners_only() -> None:
    schedule = exact_schedule(RAMPED, np.array([0.0, 0.0651, 0.1]), 0.001, interpolates=True)
    assert schedule.times.tolist() == [0.0, 0.03, 0.05, 0.051, 0.0651, 0.1]
    assert schedule.rates[:-1, 1] == pytest.approx([10.0, *4 * [-0.3 / 0.07]])
    assert schedule.sampled[:, 1] == pytest.approx(RAMPED.signals["load"].over(schedule.times))


def test_tuned_parameters_are_held_at_their_means() -> None:
    scene = scene_of(
        "[tuning]\nfriction_coefficient = { ramp = [[0, 0.1], [0.1, 0.3]] }\n"
        "base_amplitude = { steps = [[0, 1e-4], [0.033, 2e-4]] }\n"
        "[run]\nstop_time = 0.1\nstep_size = 0.02\n"
    )
    schedule = exact_schedule(scene, ENDS, 0.02, interpolates=True)
    tuned = dict(zip(schedule.tuning, schedule.tuned.T, strict=True))
    lengths = np.diff(schedule.times)
    assert lengths @ tuned["friction_coefficient"][:-1] == pytest.approx(0.1 * 0.2, rel=1e-12)
    assert tuned["base_amplitude"][np.searchsorted(schedule.times, 0.033)] == 2e-4
    assert must_hold(scene, interpolates=False)


@pytest.mark.parametrize(
    ("text", "varies"),
    [
        ("load = 1.0", False),
        ("load = { steps = [[0, 0], [0.05, 1]] }", False),
        ("load = { ramp = [[0, 0], [0.05, 1]] }", True),
        ("load = { ramp = [[0.2, 0], [0.3, 1]] }", False),
        ("load = { ramp = [[0.05, 2], [0.07, 2]] }", False),
    ],
)
def test_only_inputs_that_change_other_than_by_jumps_vary(text: str, varies: bool) -> None:
    scene = scene_of(f"[inputs]\n{text}\n[run]\nstop_time = 0.1\nstep_size = 0.01\n")
    assert must_hold(scene, interpolates=False) is varies
    assert not must_hold(scene, interpolates=True), "a line that is passed on is not held"


def test_the_error_of_a_value_is_at_least_that_of_the_search() -> None:
    reference, near, none = (
        SteadyAnswer(0.1, 2.0),
        SteadyAnswer(0.1, 2.5),
        SteadyAnswer(0.1, None, "stuck: why"),
    )
    assert steady_error(near, reference, 0).error == 0.5
    assert steady_error(reference, reference, 0).error == pytest.approx(2e-10)
    assert steady_error(none, reference, 0).error == inf
    assert steady_error(near, none, 0).reason == "stuck: why"
