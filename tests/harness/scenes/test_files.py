"""Files of scenes and devices, bundles of expectations, and files that scenes read."""

from pathlib import Path

import pytest

from slider_resonator.device.device import Device
from slider_resonator.errors import SceneError
from slider_resonator.scenes.csv_signal import csv_signal
from slider_resonator.scenes.device_file import (
    example_devices,
    possible_slips,
    read_device_file,
    to_toml,
)
from slider_resonator.scenes.scene import Scene, read_scenes, scene_from
from slider_resonator.scenes.scene_files import find_scene, find_scenes
from slider_resonator.scenes.toml_file import read_toml, toml_text
from slider_resonator.sweeping.grid import read_grid
from tests.harness.calling import call
from tests.harness.golden import assert_mistakes_as_before
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


def written(folder: Path, text: str) -> str:
    path = folder / "mine.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize("name", list(example_devices()))
def test_examples_state_faces_and_where_numbers_come_from(name: str) -> None:
    content = read_toml(example_devices()[name])
    assert content["device"]["friction_faces"] in (1, 2)
    assert "Numbers: " in content["description"]
    assert not possible_slips(content["device"])


def test_what_is_written_is_read_back(tmp_path: Path) -> None:
    device = Device(slider_mass=0.1 + 0.2, drive_frequency=1e5 / 3.0, friction_law=1)
    path = written(tmp_path, to_toml(device, 'a "quoted" title'))
    assert Device.from_mapping(read_device_file(path).values) == device


def test_a_bad_device_file_is_explained(tmp_path: Path) -> None:
    assert_mistakes_as_before(
        "device_mistakes.txt", tmp_path / "mine.toml", lambda at: read_device_file(str(at)).values
    )


def test_a_scene_may_name_its_device(tmp_path: Path) -> None:
    own = Path(written(tmp_path, "[device]\nslider_mass = 2.0\n"))
    example = scene_from({"name": "a", "title": "A", "device": "conveyor"}, "a")
    assert example.parameters == read_device_file("conveyor").values
    scene = scene_from({"name": "a", "title": "A", "device": own.name}, "a", tmp_path)
    assert (scene.parameters, scene.files) == ({"slider_mass": 2.0}, (own,))


def test_grids_have_a_device_whose_parameters_may_vary(tmp_path: Path) -> None:
    text = '[device]\nslider_mass = "50 g"\nresonator_mass = "5 g"\n[grid]\nslider_mass = [1, 2]\n'
    sweep = read_grid(Path(written(tmp_path, text)), {"damping_ratio": 0.1, "resonator_mass": 1.0})
    assert dict(sweep.task.fixed) == {"damping_ratio": 0.1, "resonator_mass": pytest.approx(5e-3)}
    assert sweep.points == ((1.0,), (2.0,))


@pytest.mark.parametrize(
    ("table", "named"),
    [
        ({"drive_frequency": 20000.0}, ["drive_frequency"]),
        ({"drive_frequency": "20 kHz"}, []),
        ({"drive_frequency": "20 kHz", "resonator_frequency": 20013.0}, ["resonator_frequency"]),
        ({"drive_frequency": 125663.7, "resonator_frequency": 125000.3}, []),
        ({"phase": -30}, ["phase"]),
        ({"base_amplitude": 1.0}, ["base_amplitude"]),
        ({"phase": 3.0}, []),
        ({}, []),
    ],
)
def test_numbers_that_may_be_hertz_are_named(table: dict[str, object], named: list[str]) -> None:
    assert [slip.split()[0] for slip in possible_slips(table)] == named


def points(path: Path, column: str) -> list[tuple[float, float]]:
    signal = csv_signal(path, column, "hold", "N")
    return list(zip(signal.times, signal.values, strict=True))


def test_the_named_column_wins_over_value(tmp_path: Path) -> None:
    path = tmp_path / "in.csv"
    path.write_text("time, value, load\n0,1,2\n1,3,4\n")
    assert points(path, "load") == [(0.0, 2.0), (1.0, 4.0)]
    assert points(path, "phase") == [(0.0, 1.0), (1.0, 3.0)]


def test_headings_may_have_units(tmp_path: Path) -> None:
    (tmp_path / "in.csv").write_text("time [ms],load (mN),mu\n0,30.1,0.1\n2.2,-5,0.2\n")
    load = {"csv": "in.csv", "column": "load", "between": "hold"}
    content = {"name": "a", "title": "A", "run": {"stop_time": 2.2e-3, "step_size": 1e-3}}
    for column in ("load", "load (mN)"):
        inputs = {"load": load | {"column": column}}
        signal = scene_from({**content, "inputs": inputs}, "a", tmp_path).signals["load"]
        assert (signal.times, signal.values) == ((0.0, 2.2e-3), (0.0301, -5e-3))
    with pytest.raises(SceneError, match=r"in.csv: heading load \(mN\) = '1 mN': not in rad; must"):
        scene_from({**content, "inputs": {"phase": load}}, "a", tmp_path)


@pytest.mark.parametrize(
    "text",
    [
        "time;load\n0;0,5\n1,5;-2e-3\n",
        "time\tload\n0\t0.5\n1.5\t-2e-3\n",
        "time,load\n0,0.5\n\n1.5,-2e-3\n,\n\n",
        "\ufeff# measured\n# on a Monday\ntime,load\n0,0.5\n# a pause\n1.5,-2e-3\n",
        '\ufeff"time";"load"\n"0";"0,5"\n"1,5";"-0,002"\n',
    ],
)
def test_what_other_programs_write_is_read(tmp_path: Path, text: str) -> None:
    path = tmp_path / "in.csv"
    path.write_text(text, encoding="utf-8")
    assert points(path, "load") == [(0.0, 0.5), (1.5, -2e-3)]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("time,load\n0\n", "line 2"),
        ("# a comment\ntime;load\n0;1\n1;x\n", "line 4: load = 'x'"),
        ("time,load\n0,1 000,5\n", "line 2"),
        ("time,load\n0,1,5\n", "line 2: 3 cells below 2 headings"),
    ],
)
def test_a_csv_that_cannot_be_used_is_named(tmp_path: Path, text: str, message: str) -> None:
    path = tmp_path / "in.csv"
    path.write_text(text)
    with pytest.raises(ValueError, match=message) as caught:
        csv_signal(path, "load", "hold", "N")
    assert str(path) in str(caught.value)


@pytest.mark.parametrize(
    ("content", "said"),
    [
        (b"a = " + b"[" * 5000, "nested too deeply"),
        (b"PK\x05\x06" + bytes(18), "not TOML: a zip archive, such as an FMU; must be UTF-8"),
        ("load = 1\ntitle = 'Größe'\n".encode("latin-1"), "line 2: .*must be UTF-8 text"),
    ],
)
def test_what_is_no_text_in_utf_8_is_named(tmp_path: Path, content: bytes, said: str) -> None:
    path = tmp_path / "mine.toml"
    path.write_bytes(content)
    with pytest.raises(SceneError, match=rf"mine\.toml: {said}"):
        read_toml(path)
