from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.choosing.input_grid import (
    inputs_as_they_vary,
    sampled_inputs,
    vary,
)
from slider_resonator.scenes.scene import Scene
from tests.harness.scene_text import scene_of

RAMP = (
    "[inputs]\nload = { ramp = [[0, 0], [0.03, 0.3], [0.1, 0]] }\n"
    "phase = { steps = [[0, 0.2], [0.051, 0.7]] }\n"
    "frequency_ratio = { ramp = [[0, 1], [0.05, 1.5]] }\n"
    "[run]\nstop_time = 0.1\nstep_size = 0.007\n"
)


@pytest.fixture
def scene() -> Scene:
    return scene_of(RAMP)


def test_a_run_holds_the_samples_of_the_schedule(scene: Scene) -> None:
    held, schedule = sampled_inputs(scene, 0.1, 0.007), scene.schedule()
    assert np.array_equal(held.times, schedule.times)
    assert np.array_equal(held.values, schedule.sampled())


@pytest.mark.parametrize("step", [0.011, 0.002])
def test_inputs_as_meant_give_their_impulse_exactly(scene: Scene, step: float) -> None:
    held = inputs_as_they_vary(scene, 0.1, step, interpolates=False)
    lengths = np.diff(held.times)
    load, _, ratio = (lengths @ held.values[:-1, column] for column in (1, 0, 2))
    assert load == pytest.approx(0.5 * 0.3 * 0.1, rel=1e-12)
    assert ratio == pytest.approx(0.05 * 1.25 + 0.05 * 1.5, rel=1e-12)


def test_a_stretch_carries_the_turns_before_it_in_its_phase(scene: Scene) -> None:
    held = inputs_as_they_vary(scene, 0.08, 0.001, 0.06, interpolates=False)
    stretch = held.stretch(0.06, 0.08, np.array([0.0651]), 100.0)
    assert stretch.times[0] == 0.0
    assert stretch.times[-1] == pytest.approx(0.02)
    assert np.abs(stretch.times - 0.0051).min() < 1e-15
    assert stretch.frequency_ratio.at(0.0) == 1.5
    assert stretch.phase.at(0.0) == pytest.approx(0.7 + (100.0 * 0.06 * 1.5) % (2.0 * np.pi))
    assert stretch.load.at(0.0201) == pytest.approx(0.3 * 2.0 / 7.0, abs=0.003)


def test_only_inputs_that_change_other_than_by_jumps_vary() -> None:
    run = "[run]\nstop_time = 0.1\nstep_size = 0.01\n"
    for text, varies in (
        ("load = 1.0", False),
        ("load = { steps = [[0, 0], [0.05, 1]] }", False),
        ("load = { ramp = [[0, 0], [0.05, 1]] }", True),
        ("load = { ramp = [[0.2, 0], [0.3, 1]] }", False),
        ("load = { ramp = [[0.05, 2], [0.07, 2]] }", False),
    ):
        assert vary(scene_of(f"[inputs]\n{text}\n{run}"), 0.1) is varies, text


TUNED = (
    "[tuning]\nfriction_coefficient = { ramp = [[0, 0.1], [0.1, 0.3]] }\n"
    "base_amplitude = { steps = [[0, 1e-4], [0.033, 2e-4]] }\n"
)


def test_lines_pass_through_the_values_of_the_scene_in_any_stretch(scene: Scene) -> None:
    grid = inputs_as_they_vary(scene, 0.08, 1.0, 0.06, interpolates=True)
    stretch = grid.stretch(0.06, 0.08, np.array([0.0651]), 100.0)
    assert stretch.times.tolist() == pytest.approx([0.0, 0.0051, 0.02])
    assert stretch.rates()[:-1, 1] == pytest.approx(-0.3 / 0.07)
    times = stretch.times + 0.06
    assert stretch.sampled()[:, 1] == pytest.approx(scene.signals["load"].over(times))


def test_a_scene_that_passes_lines_on_is_run_as_its_schedule_says(scene: Scene) -> None:
    passed = scene.interpolating(True)
    grid, schedule = sampled_inputs(passed, 0.1, 0.007), passed.schedule()
    assert grid.lines == {"load", "frequency_ratio"}
    assert np.array_equal(grid.times, schedule.times)
    whole = grid.stretch(0.0, 0.1, np.empty(0), 100.0)
    assert np.array_equal(whole.sampled(), schedule.sampled())
    assert whole.rates() == pytest.approx(schedule.rates(), rel=1e-9)
    assert vary(scene, 0.1)
    assert not vary(passed, 0.1), "a line that is passed on is not held"


def test_tuned_parameters_are_held_in_runs_and_at_their_means_in_the_reference() -> None:
    scene = scene_of(f"{TUNED}[run]\nstop_time = 0.1\nstep_size = 0.02\n")
    held = sampled_inputs(scene, 0.1, 0.02).stretch(0.0, 0.1, np.empty(0), 100.0)
    assert held.tuning["friction_coefficient"].at(0.03) == pytest.approx(0.14)
    assert 0.033 in held.times, "a jump is a communication point"
    assert held.tuning["base_amplitude"].at(0.033) == 2e-4
    mean = inputs_as_they_vary(scene, 0.1, 0.02, interpolates=True)
    column = mean.values[:-1, mean.names.index("friction_coefficient")]
    assert np.diff(mean.times) @ column == pytest.approx(0.1 * 0.2, rel=1e-12)
    assert vary(scene, 0.1)
