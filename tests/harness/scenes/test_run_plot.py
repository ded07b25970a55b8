from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.output.plot_style import save
from slider_resonator.scenes.run_plot import ZOOM_PERIODS, run_figure, schedule_to_plot
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.scene_files import find_scene
from slider_resonator.scenes.signals_plot import SMOOTH_POINTS


@pytest.fixture
def scene() -> Scene:
    return find_scene("changing_inputs")


def test_a_run_becomes_a_picture(instance: Instance, scene: Scene, tmp_path: Path) -> None:
    record = run(instance, scene.parameters, scene.schedule())
    for suffix in (".png", ".svg", ".pdf"):
        save(run_figure(record, scene), tmp_path / f"run{suffix}")
    picture = imread(tmp_path / "run.png")
    assert picture.shape[1] == 1200
    assert np.ptp(picture[..., :3]) > 0.5, "something must be drawn"
    assert "velocity" in (tmp_path / "run.svg").read_text()


def test_a_coarse_run_is_drawn_without_its_fast_motion(instance: Instance) -> None:
    scene = find_scene("long_run")
    record = run(instance, scene.parameters, scene.schedule())
    assert len(run_figure(record, scene).axes) == 2


@pytest.mark.parametrize("name", ["table_1", "long_run", "changing_inputs"])
def test_the_last_drive_periods_are_drawn_smoothly_under_the_same_inputs(name: str) -> None:
    scene = find_scene(name)
    period = 2.0 * np.pi / scene.device.drive_frequency
    own, shown = scene.schedule(), schedule_to_plot(scene)
    late = shown.times[shown.times >= own.times[-1] - (ZOOM_PERIODS - 0.5) * period]
    assert np.diff(late).max() <= 1.01 * period / SMOOTH_POINTS * (1.0 + 1e-6)
    assert len(shown.times) <= len(own.times) + ZOOM_PERIODS * SMOOTH_POINTS + 1
    assert shown.held() == own.held(), "the motion must be that of the scene"


def test_the_lines_and_constant_inputs_are_named(instance: Instance, tmp_path: Path) -> None:
    scene = find_scene("table_1", {"load": 0.05, "phase": 0.4})
    record = run(instance, scene.parameters, schedule_to_plot(scene))
    save(run_figure(record, scene), tmp_path / "run.svg")
    text = (tmp_path / "run.svg").read_text()
    assert "steady, for these inputs" in text
    assert "phase 22.92 deg, load 50 mN" in text
    assert "frequency_ratio" not in text, "it is at its start"


def test_a_prediction_is_drawn_where_it_is_valid(instance: Instance) -> None:
    scene = find_scene("table_1", {"load": 0.5})  # above the friction of both faces
    axes = run_figure(run(instance, scene.parameters, scene.schedule()), scene).axes[1]
    assert [line.get_label() for line in axes.get_lines()] == ["mean velocity"]


def test_a_start_far_outside_does_not_set_the_axis(instance: Instance) -> None:
    scene = find_scene("table_1")
    record = run(instance, scene.parameters, scene.schedule())
    spike = np.where(record.times < 0.02 * record.times[-1], 5.0, record["mean_velocity"])
    kicked = replace(record, outputs={**record.outputs, "mean_velocity": spike})
    axes = run_figure(kicked, scene).axes[1]
    assert axes.get_ylim()[1] < 0.2, "5 m/s is named, not drawn"
    (words,) = [text.get_text() for text in axes.texts]
    assert words == f"start beyond the axis: {spike.min():.3g} to 5"
