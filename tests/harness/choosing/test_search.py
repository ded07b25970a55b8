"""Steps and tolerances that are tried, what their errors are measured against, and their cost."""

from itertools import pairwise
from math import inf, log2, pi

import pytest
from hypothesis import given
from hypothesis import strategies as st

from slider_resonator.choosing import probe as probes
from slider_resonator.choosing.candidate import Candidate, coarsest
from slider_resonator.choosing.probe import CAUTION, Probe
from slider_resonator.device.model import Model
from slider_resonator.fmu.instance import Instance
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
RESOLVED, AVERAGED = Model(2, 0), Model(0, 0, 1)


@pytest.mark.usefixtures("stated_costs")
def test_partial_probe_confirms_only_the_resolved_model(
    instance: Instance, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(probes, "LONGEST", 1e-3)
    text = f"[inputs]\nfrequency_ratio = 1.01\n{RUN.format(1e5, 'position', 0.1)}"
    probe = Probe(instance, scene_of(text))
    step = probe.scene.step_size
    averaged, _ = probe.measure(Candidate(AVERAGED, 1e-8, step))
    resolved, seconds = probe.measure(Candidate(RESOLVED, 1e-8, step))
    assert probe.covers == "beginning"
    assert averaged["position"].error == inf
    assert "too long" in averaged["position"].reason
    assert resolved["position"].error > 5.0 * CAUTION * 1e-12 * resolved["position"].magnitude
    assert seconds > 0.01


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
