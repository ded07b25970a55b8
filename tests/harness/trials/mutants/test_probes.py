from __future__ import annotations

from pathlib import Path

from slider_resonator.scenes.scene import read_scene
from slider_resonator.trials.mutants.probes import MODELS, write_probes


def test_probes_are_sound_scenes_of_every_model(tmp_path: Path) -> None:
    scenes = [read_scene(path) for path in write_probes(tmp_path, len(MODELS), seed=5)]
    models = [(scene.device.fidelity, scene.device.friction_law) for scene in scenes]
    assert set(models) == {(2, 0), (1, 0), (0, 0), (2, 1), (1, 1), (0, 1)}
    quantities = {expect.quantity for scene in scenes for expect in scene.expect}
    assert {"position", "contact_mode", "steady_velocity"} <= quantities


def test_probes_are_drawn_by_their_seed(tmp_path: Path) -> None:
    texts = []
    for name, seed in (("a", 1), ("b", 1), ("c", 2)):
        folder = tmp_path / name
        folder.mkdir()
        texts.append([path.read_text() for path in write_probes(folder, 3, seed)])
    assert texts[0] == texts[1]
    assert texts[0] != texts[2]
