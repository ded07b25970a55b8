from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from matplotlib.image import imread

from harness.drive import Instance, run
from harness.errors import HarnessError
from harness.plot import plot_run
from harness.scene import Scene, find_scene, read_scene


@pytest.fixture
def scene() -> Scene:
    return read_scene(find_scene("changing_inputs"))


def test_a_run_becomes_a_picture(instance: Instance, scene: Scene, tmp_path: Path) -> None:
    record = run(instance, scene.parameters, scene.schedule())
    for suffix in (".png", ".svg", ".pdf"):
        plot_run(record, scene, tmp_path / f"run{suffix}")
    picture = imread(tmp_path / "run.png")
    assert picture.shape[1] == 1200
    assert np.ptp(picture[..., :3]) > 0.5, "something must be drawn"
    assert "velocity" in (tmp_path / "run.svg").read_text()


def test_a_coarse_run_is_drawn_without_its_fast_motion(instance: Instance, tmp_path: Path) -> None:
    path = find_scene("long_run")
    scene = read_scene(path)
    record = run(instance, scene.parameters, scene.schedule())
    plot_run(record, scene, tmp_path / "run.png")
    assert imread(tmp_path / "run.png").shape[0] < 700


def test_an_unknown_suffix_is_refused(instance: Instance, scene: Scene, tmp_path: Path) -> None:
    record = run(instance, scene.parameters, scene.schedule())
    with pytest.raises(HarnessError, match=r"\.png, \.svg, \.pdf"):
        plot_run(record, scene, tmp_path / "run.txt")
    assert not list(tmp_path.iterdir())
