from __future__ import annotations

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.fmu.instance import Instance
from slider_resonator.scenes.scene import read_scene
from slider_resonator.scenes.scene_files import find_scene


def test_everything_is_computed_once(instance: Instance) -> None:
    side = FmuSide(instance, read_scene(find_scene("table_1")))
    assert side.record is side.record
    assert side.steady is side.steady


def test_the_blocking_force_does_not_depend_on_the_load_of_the_scene(instance: Instance) -> None:
    loaded = FmuSide(instance, read_scene(find_scene("table_1"), {"load": 0.3}))
    free = FmuSide(instance, read_scene(find_scene("table_1")))
    assert loaded.blocking.blocking_force == free.blocking.blocking_force
