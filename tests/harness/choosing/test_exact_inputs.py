from __future__ import annotations

import numpy as np
import pytest

from slider_resonator.choosing.reference import exact_schedule, must_hold
from slider_resonator.scenes.scene import Scene
from tests.harness.scene_text import scene_of

RAMP = (
    "[inputs]\nload = { ramp = [[0, 0], [0.03, 0.3], [0.1, 0]] }\n"
    "phase = { steps = [[0, 0.2], [0.051, 0.7]] }\n"
    "frequency_ratio = { ramp = [[0, 1], [0.05, 1.5]] }\n"
    "[run]\nstop_time = 0.1\nstep_size = 0.007\n"
)
ENDS = np.array([0.0, 0.1])


@pytest.fixture
def scene() -> Scene:
    return scene_of(RAMP)


@pytest.mark.parametrize("step", [0.011, 0.002])
def test_held_inputs_give_their_impulse_exactly(scene: Scene, step: float) -> None:
    schedule = exact_schedule(scene, ENDS, step, interpolates=False)
    assert not schedule.ramps
    load, ratio = (np.diff(schedule.times) @ schedule.sampled[:-1, i] for i in (1, 2))
    assert load == pytest.approx(0.5 * 0.3 * 0.1, rel=1e-12)
    assert ratio == pytest.approx(0.05 * 1.25 + 0.05 * 1.5, rel=1e-12)


def test_lines_that_are_passed_on_need_their_corners_only(scene: Scene) -> None:
    schedule = exact_schedule(scene, np.array([0.0, 0.0651, 0.1]), 0.001, interpolates=True)
    assert schedule.times.tolist() == [0.0, 0.03, 0.05, 0.051, 0.0651, 0.1]
    assert schedule.rates[:-1, 1] == pytest.approx([10.0, *4 * [-0.3 / 0.07]])
    assert schedule.sampled[:, 1] == pytest.approx(scene.signals["load"].over(schedule.times))


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
