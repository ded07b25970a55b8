"""Files of several scenes, bundles of expectations, and expectations of several quantities."""

from pathlib import Path

import pytest

from slider_resonator.errors import SceneError
from slider_resonator.scenes.scene import Scene, read_scenes, scene_from
from slider_resonator.scenes.scene_files import find_scene, find_scenes
from slider_resonator.scenes.toml_file import toml_text
from tests.harness.calling import call
from tests.harness.scene_text import read_scene, scene_of

FAMILY = """
title = "Shared"
expect_bundles = ["predictions"]
device = { friction_coefficient = 0.2, damping_ratio = 0.1 }
run = { drive_periods = 2, steps_per_period = 4 }

[[expect]]
quantity = "position"
reference = "located_events"
relative = 1e-8
why = "shared"

[[variant]]
name = "first"

[[variant]]
name = "second"
title = "Own"
device = { damping_ratio = 0.3 }
inputs = { load = 0.01 }
expect = [{ quantity = "position", reference = "located_events", relative = 1e-6 }]
"""


def family(folder: Path, text: str = FAMILY) -> Path:
    path = folder / "family.toml"
    path.write_text(text)
    return path


def bounds(scene: Scene) -> dict[str, float]:
    return {expect.quantity: expect.relative for expect in scene.expect}


def test_each_variant_is_a_scene_that_differs_in_its_keys(tmp_path: Path) -> None:
    path = family(tmp_path)
    first, second = read_scenes(path)
    assert (first.name, first.title, first.source) == ("first", "Shared", f"{path}#first")
    assert (second.name, second.title, second.files) == ("second", "Own", (path,))
    assert first.parameters == {"friction_coefficient": 0.2, "damping_ratio": 0.1}
    assert second.parameters == {"friction_coefficient": 0.2, "damping_ratio": 0.3}
    assert (first.values["load"], second.values["load"]) == (0.0, 0.01)
    assert bounds(first)["position"] == 1e-8
    assert bounds(second)["position"] == 1e-6
    assert {expect.why for expect in second.expect if expect.quantity == "position"} == {"shared"}
    assert len(first.expect) == len(second.expect) == 3


def test_a_variant_is_found_by_file_and_name_or_with_all_others(tmp_path: Path) -> None:
    path = family(tmp_path)
    assert find_scene(f"{path}#second", {"load": 0.5}).values["load"] == 0.5
    assert [scene.name for scene in find_scenes([str(path)])] == ["first", "second"]
    assert [scene.name for scene in find_scenes([str(tmp_path)])] == ["first", "second"]
    with pytest.raises(SceneError, match=r"has the scenes first, second; must be one: .*#NAME"):
        find_scene(str(path))
    with pytest.raises(SceneError, match="unknown scene 'secnd'; did you mean 'second'"):
        find_scene(f"{path}#secnd")


def test_a_scene_of_data_must_be_one() -> None:
    several = {"title": "x", "variant": [{"name": "a"}, {"name": "b"}]}
    with pytest.raises(SceneError, match="has the scenes a, b"):
        scene_from(several, "data")
    assert scene_from({**several, "variant": [{"name": "a"}]}, "data").name == "a"


RUN = "[run]\ndrive_periods = 2\nsteps_per_period = 4\n"
OWN = '[[expect]]\nquantity = ["position", "velocity"]\nreference = "{}"\nrelative = 1e-5\n{}'


def test_own_expectations_replace_those_of_a_bundle() -> None:
    bundle = scene_of('expect_bundles = ["motion"]\n' + RUN)
    text = 'expect_bundles = ["motion"]\n' + RUN + OWN.format("located_events", "")
    scene = scene_of(text)
    assert len(scene.expect) == len(bundle.expect)
    assert bounds(scene) == {**bounds(bundle), "position": 1e-5, "velocity": 1e-5}
    other = scene_of(text.replace("located_events", "averaged") + 'why = "x"\n')
    assert len(other.expect) == len(bundle.expect) + 2, "another reference is another expectation"


def test_an_unknown_bundle_is_named_with_those_that_there_are() -> None:
    with pytest.raises(SceneError, match=r"'motoin'; did you mean 'motion'\? \(must be one of"):
        scene_of('expect_bundles = ["motoin"]\n')
    with pytest.raises(SceneError, match=r"expect_bundles = 'motion': must be a list in brackets"):
        scene_of('expect_bundles = "motion"\n')


def test_the_text_of_a_variant_is_that_scene_alone(tmp_path: Path) -> None:
    path = tmp_path / "shown.toml"
    path.write_text(call("scenes", "--show", f"{family(tmp_path)}#second").stdout)
    shown, second = read_scene(path), find_scene(f"{tmp_path / 'family.toml'}#second")
    assert shown.expect == second.expect
    of_second = (second.parameters, second.signals, second.run)
    assert (shown.parameters, shown.signals, shown.run) == of_second
    text = 'name = "x"\n\n[run]\nstop_time = 1.0\n'
    assert toml_text({"name": "x", "run": {"stop_time": 1.0}}) == text
