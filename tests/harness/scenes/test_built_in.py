"""The built-in scenes and the bundles of expectations that they take."""

import pickle
from collections import defaultdict
from collections.abc import Callable, Iterator

import pytest

from slider_resonator.device.interface import HELD, INPUTS, PARAMETERS, VARIABLES
from slider_resonator.scenes.expansion import bundles
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.scene_files import built_in_scenes, find_scene, is_core
from slider_resonator.scenes.schema import ExpectTable
from tests.harness.scene_text import built_in


def test_built_in_scenes_are_sound() -> None:
    for name, scene in built_in().items():
        assert len(name) <= 24
        assert len(scene.title) <= 60, name
        assert scene.description, name
        assert scene.expect, f"{name} must expect something"
        assert pickle.loads(pickle.dumps(scene)) == scene, f"{name} must be data that can be sent"


def test_a_scene_of_each_file_is_found_by_its_name() -> None:
    for name in {file: name for name, file in built_in_scenes().items()}.values():
        assert find_scene(name) == built_in()[name]


def test_table_1_and_the_core_come_first() -> None:
    assert list(built_in()) == list(built_in_scenes())
    assert next(iter(built_in())) == "table_1"
    core = [is_core(scene) for scene in built_in().values()]
    assert core == sorted(core, reverse=True)
    assert 35 <= sum(core) <= 50


@pytest.mark.parametrize("name", bundles())
def test_a_bundle_is_valid_and_taken_by_a_scene(name: str) -> None:
    expects = [ExpectTable.model_validate(table) for table in bundles()[name]["expect"]]
    subjects = [(one.quantity, one.reference) for one in expects]
    assert len(set(subjects)) == len(subjects)
    taken = ({(e.quantity, e.reference) for e in scene.expect} for scene in built_in().values())
    assert any(set(subjects) <= quantities for quantities in taken)


MOTION = {"position", "velocity", "mean_velocity", "mean_velocity_in_run"}
Model = tuple[int, int | str]
"""Friction law, and fidelity or order of averages."""
MODELS: dict[Model, set[str]] = {
    (law, level): {
        *({"bristle_stiffness", "bristle_damping"} if law == 0 else ()),
        *({"initial_bristle_deflection"} if law == 0 or level == "order 1" else ()),
        *({"tolerance"} if level == "order 1" or (law == 0 and level in (1, 2)) else ()),
    }
    for law in (0, 1)
    for level in (1, 2, "order 1", "order 2")
}
"""Models, and parameters that mean nothing to them."""


def tried(values: Callable[[Scene], Iterator[str]]) -> dict[Model, set[str]]:
    """The names that `values` gives of scenes whose motion is compared with a reference."""
    found: dict[Model, set[str]] = defaultdict(set)
    for scene in built_in().values():
        for point in scene.points():
            device = point.scene.device
            if MOTION & {expect.quantity for expect in scene.expect if expect.reference}:
                level = device.fidelity or f"order {device.averaging_order}"
                found[device.friction_law, level] |= {*values(point.scene)}
    assert set(found) == set(MODELS)
    return found


def test_every_value_changes_in_a_run_of_every_model() -> None:
    def changed(scene: Scene) -> Iterator[str]:
        signals = {**scene.signals, **scene.tuning}
        return (name for name, signal in signals.items() if len(set(signal.values)) > 1)

    missing = {model: {*HELD, *INPUTS} - names for model, names in tried(changed).items()}
    assert not any(missing.values()), f"no scene changes {missing}"


def test_no_parameter_keeps_its_start_in_all_scenes_of_a_model() -> None:
    def other(scene: Scene) -> Iterator[str]:
        return (name for name, value in scene.parameters.items() if value != VARIABLES[name].start)

    chosen = {"fidelity", "averaging_order", "friction_law"}
    missing = {m: {*PARAMETERS} - chosen - MODELS[m] - names for m, names in tried(other).items()}
    assert not any(missing.values()), f"no scene has another value of {missing}"
