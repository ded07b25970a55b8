"""The built-in scenes and the bundles of expectations that they take."""

from __future__ import annotations

import pickle
from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product

import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.interface import OUTPUTS
from slider_resonator.scenes.device_file import example_devices, read_device
from slider_resonator.scenes.expansion import bundles
from slider_resonator.scenes.expect_table import ExpectTable
from slider_resonator.scenes.scene_files import built_in_scenes, find_scene, find_scenes, is_core

SCENES = {scene.name: scene for scene in find_scenes([])}


def test_built_in_scenes_are_sound_and_found_by_their_names() -> None:
    for name, scene in SCENES.items():
        assert find_scene(name) == scene
        assert len(name) <= 24
        assert len(scene.title) <= 60, name
        assert scene.description, name
        assert scene.expect, f"{name} must expect something"
        assert pickle.loads(pickle.dumps(scene)) == scene, f"{name} must be data that can be sent"


def test_table_1_and_the_core_come_first() -> None:
    assert list(SCENES) == list(built_in_scenes())
    assert next(iter(SCENES)) == "table_1"
    core = [is_core(scene) for scene in SCENES.values()]
    assert core == sorted(core, reverse=True)
    assert 35 <= sum(core) <= 50


@pytest.mark.parametrize("name", example_devices())
def test_an_example_device_is_that_of_a_core_scene(name: str) -> None:
    order = Device().averaging_order
    core = [replace(s.device, averaging_order=order) for s in SCENES.values() if is_core(s)]
    assert Device.from_mapping(read_device(name)) in core


def test_the_scenes_that_the_paper_calls_for_are_built_in() -> None:
    assert set(SCENES) >= {
        *("table_1", "table_1_high_frequency", "phase_sweep", "load_speed", "blocking_force"),
        *("ratio_3", "detuned_beat", "pushed_at_rest", "lift_off", "changing_inputs"),
    }


@pytest.mark.parametrize("name", bundles())
def test_a_bundle_is_valid_and_taken_by_a_scene(name: str) -> None:
    expects = [ExpectTable.model_validate(table) for table in bundles()[name]["expect"]]
    subjects = [(one.quantity, one.reference) for one in expects]
    assert len(set(subjects)) == len(subjects)
    taken = ({(e.quantity, e.reference) for e in scene.expect} for scene in SCENES.values())
    assert any(set(subjects) <= quantities for quantities in taken)


MODELS = list(product((0, 1, 2), (0, 1)))
"""Fidelity and friction law."""

SHOWN_BY: Mapping[str, Sequence[str]] = {
    **{
        name: (name,)
        for name in (
            *("position", "velocity", "resonator_displacement", "resonator_velocity"),
            *("normal_force", "friction_force", "contact_mode"),
        )
    },
    "mean_velocity": ("mean_velocity_in_run",),
    "reversals": ("reversals_in_run",),
    "stick_fraction": ("stick_fraction_in_run", "stick_fraction"),
    "last_event_time": ("event_times",),
    "steady_velocity": ("predicted_velocity_in_run",),
    "blocking_force": ("predicted_blocking_force_in_run",),
}
"""Output to the quantities that compare it."""


@pytest.fixture(scope="module")
def compared() -> dict[tuple[int, int], set[str]]:
    """The quantities that built-in scenes compare, by fidelity and friction law."""
    found: dict[tuple[int, int], set[str]] = {model: set() for model in MODELS}
    for scene in SCENES.values():
        for point in scene.points():
            device = point.scene.device
            model = device.fidelity, device.friction_law
            found[model] |= {expect.quantity for expect in scene.expect}
    return found


@pytest.mark.parametrize(("fidelity", "law"), MODELS)
def test_every_output_is_compared_at_each_fidelity_and_law(
    compared: dict[tuple[int, int], set[str]], fidelity: int, law: int
) -> None:
    for output in OUTPUTS:
        assert compared[fidelity, law] & set(SHOWN_BY[output]), output
