from __future__ import annotations

from studies.mutants.probes import MODELS, probe_scenes


def test_probes_are_scenes_of_every_model() -> None:
    scenes = probe_scenes(len(MODELS), seed=5)
    models = [(scene.device.fidelity, scene.device.friction_law) for scene in scenes]
    assert set(models) == {(2, 0), (1, 0), (0, 0), (2, 1), (1, 1), (0, 1)}
    quantities = {expect.quantity for scene in scenes for expect in scene.expect}
    assert {"position", "contact_mode", "steady_velocity"} <= quantities


def test_probes_are_drawn_by_their_seed() -> None:
    assert probe_scenes(3, seed=1) == probe_scenes(3, seed=1)
    assert probe_scenes(3, seed=1) != probe_scenes(3, seed=2)
