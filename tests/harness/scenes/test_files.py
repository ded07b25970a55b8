"""Device files, and files that scenes read."""

from math import pi
from pathlib import Path

import pytest

from slider_resonator.device.device import Device
from slider_resonator.errors import SceneError
from slider_resonator.scenes.csv_signal import csv_signal
from slider_resonator.scenes.device_file import (
    device_content,
    example_devices,
    possible_slips,
    read_device,
    to_toml,
)
from slider_resonator.scenes.scene import scene_from
from slider_resonator.scenes.toml_file import read_toml
from slider_resonator.sweeping.grid import read_grid
from tests.harness.scene_text import read_scene


def written(folder: Path, text: str) -> str:
    path = folder / "mine.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


def test_texts_with_units_and_numbers_mix(tmp_path: Path) -> None:
    read = read_device(
        written(tmp_path, '[device]\ndrive_frequency = "20 kHz"\nslider_mass = 0.05\n')
    )
    assert read == pytest.approx({"drive_frequency": 2.0 * pi * 20e3, "slider_mass": 0.05})


@pytest.mark.parametrize("name", list(example_devices()))
def test_examples_state_faces_and_where_numbers_come_from(name: str) -> None:
    content = device_content(example_devices()[name])
    assert content["device"]["friction_faces"] in (1, 2)
    assert "Numbers: " in content["description"]
    assert not possible_slips(content["device"])


def test_what_is_written_is_read_back(tmp_path: Path) -> None:
    device = Device(slider_mass=0.1 + 0.2, drive_frequency=1e5 / 3.0, friction_law=1)
    path = written(tmp_path, to_toml(device, 'a "quoted" title'))
    assert Device.from_mapping(read_device(path)) == device


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('[device]\nresonator_mass = "5 kHz"', "device.resonator_mass = '5 kHz': not in kg"),
        ("[device]\nresonator_mas = 1", "did you mean 'resonator_mass'?"),
        ("[device]\nslider_mass = -1", "device.slider_mass = -1: must be a finite number of at"),
        ("[device]\nslider_mass = true", "device.slider_mass = true: must be a number"),
        ('[device]\nslider_mass = "-1 g"', "device.slider_mass = -0.001: must be a finite number"),
        ('[device]\nfriction_faces = "two"', "device.friction_faces = 'two': must be a number"),
        ("[device]\nfriction_faces = 3", "must be an integer from 1 to 2"),
        ("slider_mass = 1", "a parameter must be below [device]"),
        ("", "must have a table headed [device]"),
        ("device = 3", "must have a table headed [device]"),
        ("[device]\n[run]\nstop_time = 1.0", "is a scene file; must be a device file"),
        ('measures = ["position"]', "is a grid file; must be a device file"),
    ],
)
def test_bad_file_is_explained(tmp_path: Path, text: str, said: str) -> None:
    path = written(tmp_path, text)
    with pytest.raises(SceneError) as error:
        read_device(path)
    assert said in str(error.value)
    assert path in str(error.value)


def test_each_mistake_of_a_device_has_a_line(tmp_path: Path) -> None:
    text = '[device]\nslider_mass = "5 Hz"\nmu = 0.2\ndamping_ratio = 0.1\nnormal_preload = -1\n'
    with pytest.raises(SceneError) as error:
        read_device(written(tmp_path, text))
    lines = str(error.value).splitlines()
    for line, name in zip(lines, ("slider_mass", "'mu'", "normal_preload"), strict=True):
        assert name in line


def test_scenes_take_units_and_other_files_are_named(tmp_path: Path) -> None:
    content = {"name": "a", "title": "a", "device": {"drive_frequency": "20 kHz"}}
    assert scene_from(content, "a").parameters["drive_frequency"] == pytest.approx(4e4 * pi)
    with pytest.raises(SceneError, match=r"device\.drive_frequency = '20 kg': not in rad/s"):
        scene_from({**content, "device": {"drive_frequency": "20 kg"}}, "a")
    with pytest.raises(SceneError, match="is a device file; must be a scene file"):
        read_scene(Path(written(tmp_path, "[device]\nslider_mass = 1.0\n")))
    with pytest.raises(SceneError, match="is a grid file; must be a scene file"):
        read_scene(Path(written(tmp_path, "[grid]\nphase = [0.0, 1.0]\n")))
    with pytest.raises(SceneError, match="is a scene file; must be a grid file"):
        read_grid(Path(written(tmp_path, 'name = "a"\n[run]\nstop_time = 1.0\n')))


def test_a_scene_may_name_its_device(tmp_path: Path) -> None:
    own = Path(written(tmp_path, "[device]\nslider_mass = 2.0\n"))
    example = scene_from({"name": "a", "title": "A", "device": "conveyor"}, "a")
    assert example.parameters == read_device("conveyor")
    scene = scene_from({"name": "a", "title": "A", "device": own.name}, "a", tmp_path)
    assert (scene.parameters, scene.files) == ({"slider_mass": 2.0}, (own,))
    with pytest.raises(SceneError, match="a: device: unknown device 'convoyer'; did you mean"):
        scene_from({"name": "a", "title": "A", "device": "convoyer"}, "a")
    with pytest.raises(SceneError, match=r"a: device: none\.toml: cannot be read"):
        scene_from({"name": "a", "title": "A", "device": "none.toml"}, "a")


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
        ({"phase": 3.0}, []),
        ({}, []),
    ],
)
def test_numbers_that_may_be_hertz_are_named(table: dict[str, object], named: list[str]) -> None:
    assert [slip.split()[0] for slip in possible_slips(table)] == named


def points(path: Path, column: str) -> list[tuple[float, float]]:
    signal = csv_signal(path, column, "hold")
    return list(zip(signal.times, signal.values, strict=True))


def test_the_named_column_wins_over_value(tmp_path: Path) -> None:
    path = tmp_path / "in.csv"
    path.write_text("time, value, load\n0,1,2\n1,3,4\n")
    assert points(path, "load") == [(0.0, 2.0), (1.0, 4.0)]
    assert points(path, "phase") == [(0.0, 1.0), (1.0, 3.0)]


@pytest.mark.parametrize(
    "text",
    [
        "time;load\n0;0,5\n1,5;-2e-3\n",
        "time\tload\n0\t0.5\n1.5\t-2e-3\n",
        "sep=;\ntime;load\n0;0,5\n1,5;-2e-3\n",
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
        ("", "must begin with 'time'"),
        ("t,load\n0,1\n", "must begin with 'time'"),
        ("time,lod\n0,1\n", "no column 'load'"),
        ("time,load\n0,1\n1,x\n", "line 3"),
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
        csv_signal(path, "load", "hold")
    assert str(path) in str(caught.value)


def test_an_fmu_is_named_as_what_it_is(python_fmu: Path) -> None:
    with pytest.raises(SceneError, match=r"\.fmu: .*a zip archive, such as an FMU; must be UTF-8"):
        read_toml(python_fmu)


def test_another_encoding_is_refused_with_its_line(tmp_path: Path) -> None:
    path = tmp_path / "latin.toml"
    path.write_text("load = 1\ntitle = 'Größe'\n", encoding="latin-1")
    with pytest.raises(SceneError, match=r"latin\.toml: line 2: .*must be UTF-8 text"):
        read_toml(path)
