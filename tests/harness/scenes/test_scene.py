from __future__ import annotations

import math
import tomllib
from pathlib import Path

import jsonschema
import pytest

from slider_resonator.device.device import Device
from slider_resonator.device.interface import TUNABLES
from slider_resonator.errors import SceneError
from slider_resonator.scenes.input_tables import TuningTable
from slider_resonator.scenes.json_schema import scene_schema
from slider_resonator.scenes.scene import scene_from
from slider_resonator.scenes.scene_files import find_scene
from tests.harness.scene_text import read_scene, scene_file

RUN = "[run]\ndrive_periods = 10\nsteps_per_period = 4\n"


def test_a_scene_of_a_name_and_a_title_is_table_1(tmp_path: Path) -> None:
    scene = read_scene(scene_file(tmp_path, RUN))
    assert scene.device.base_amplitude == 1e-4
    assert scene.values == {"phase": 0.0, "load": 0.0, "frequency_ratio": 1.0}
    schedule = scene.schedule()
    assert len(schedule.times) == 41
    assert schedule.times[-1] == pytest.approx(10 * 2 * 3.141592653589793 / 3500)


def test_inputs_of_every_kind(tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time,load\n0,0.0\n0.1,0.05\n")
    scene = read_scene(
        scene_file(
            tmp_path,
            '[inputs]\nphase = { steps = [[0, 0], [0.01, 0.4]] }\nload = { csv = "load.csv" }\n'
            "frequency_ratio = { ramp = [[0, 1], [1, 2]] }\n"
            "[run]\nstop_time = 0.1\nstep_size = 0.007\n",
        )
    )
    signals = scene.signals
    assert signals["phase"].at(0.01) == 0.4
    assert signals["load"].at(0.05) == pytest.approx(0.025)
    assert signals["frequency_ratio"].at(0.5) == pytest.approx(1.5)
    assert 0.01 in scene.schedule().times, "a step of an input is a communication point"


def test_values_may_have_a_unit(tmp_path: Path) -> None:
    text = """
    [inputs]
    phase = "30 deg"
    load = { steps = [[0.0, "0 N"], ["1 ms", "50 mN"]] }
    [tuning]
    drive_frequency = { ramp = [[0.0, "20 kHz"], ["2 ms", 130e3]] }
    [beside]
    device = { slider_mass = "5 g" }
    inputs = { load = "2 mN" }
    [run]
    stop_time = "2 ms"
    step_sizes = ["10 us", 2e-5]
    [[expect]]
    quantity = "last_event_time"
    at_most = "1 ms"
    why = "test"
    [need]
    position = { abs = "1 um", rel = "1 %" }
    [sweep]
    variable = "damping_ratio"
    values = [0.1, "5 %"]
    """
    path = scene_file(tmp_path, text)
    jsonschema.validate(tomllib.loads(path.read_text()), scene_schema())
    scene = read_scene(path)
    assert scene.signals["phase"].at(0.0) == pytest.approx(math.pi / 6.0)
    assert (scene.signals["load"].times, scene.signals["load"].values) == ((0.0, 1e-3), (0.0, 0.05))
    assert scene.tuning["drive_frequency"].values == pytest.approx((40e3 * math.pi, 130e3))
    assert scene.beside is not None
    assert scene.beside.parameters == {"slider_mass": 0.005}
    assert scene.beside.signals["load"].at(0.0) == 0.002
    assert scene.run is not None
    assert (scene.stop_time, scene.run.step_sizes) == (2e-3, (1e-5, 2e-5))
    assert scene.expect[0].at_most == 1e-3
    assert scene.need is not None
    assert scene.need.position is not None
    assert (scene.need.position.abs, scene.need.position.rel) == pytest.approx((1e-6, 0.01))
    assert scene.sweep is not None
    assert scene.sweep.values == (0.1, 0.05)


def test_tuned_parameters_start_as_the_tuning_says_and_a_value_replaces_it(tmp_path: Path) -> None:
    text = "[tuning]\nnormal_preload = { steps = [[0, 2.0], [0.01, 3.0]] }\n"
    scene = read_scene(scene_file(tmp_path, RUN + text))
    assert scene.device.normal_preload == 2.0
    schedule = scene.schedule()
    assert 0.01 in schedule.times, "a step of a parameter is a communication point"
    devices = [inputs.tuned_device(scene.device) for inputs in schedule.held()]
    assert [device.normal_preload for device in devices] == [2.0, 3.0]
    replaced = scene.with_values({"normal_preload": 5.0})
    assert replaced.device.normal_preload == 5.0
    assert not replaced.schedule().tuning


DEVIATING = """
[run]
stop_time = 0.1
step_size = 0.01
[inputs]
frequency_deviation = 0.1
"""


def test_a_constant_deviation_is_that_of_the_device(tmp_path: Path) -> None:
    scene = read_scene(scene_file(tmp_path, DEVIATING))
    assert scene.parameters == {"frequency_deviation": 0.1}
    assert scene.device == Device(drive_frequency=3500.0 * 1.1)
    assert not scene.tuning


def test_deviations_over_time_are_of_what_the_drive_is_tuned_to(tmp_path: Path) -> None:
    text = (
        DEVIATING
        + """
amplitude_deviation = { steps = [[0.0, -1.0], [0.05, 0.5]] }
[tuning]
base_amplitude = { steps = [[0.0, 1e-4], [0.07, 2e-4]] }
"""
    )
    scene = read_scene(scene_file(tmp_path, text))
    assert scene.device == Device(), "that of the parameters"
    found = [held.tuned_device(scene.device) for held in scene.schedule().held()]
    w = 3500.0 * 1.1
    assert [(d.base_amplitude, d.drive_frequency) for d in found] == [
        (0.0, w),
        (1e-4 * 1.5, w),
        (2e-4 * 1.5, w),
    ]
    off = scene.with_values({"amplitude_deviation": -0.5})
    found = [held.tuned_device(off.device) for held in off.schedule().held()]
    assert [d.base_amplitude for d in found] == [0.5e-4, 1e-4]


def test_every_tunable_parameter_has_a_key() -> None:
    assert tuple(TuningTable.model_fields) == TUNABLES


def test_a_csv_can_be_held_and_its_value_column_can_be_called_value(tmp_path: Path) -> None:
    (tmp_path / "l.csv").write_text("time,value\n0,1\n0.05,2\n")
    text = '[inputs]\nload = { csv = "l.csv", between = "hold" }\n'
    load = read_scene(scene_file(tmp_path, text + RUN)).signals["load"]
    assert (load.at(0.049), load.jumps) == (1.0, (0.05,))


def test_a_slower_drive_may_make_a_run_longer_than_its_csv(tmp_path: Path) -> None:
    (tmp_path / "x.csv").write_text("time,load\n0,0\n0.018,1\n")
    scene = read_scene(scene_file(tmp_path, RUN + '[inputs]\nload = { csv = "x.csv" }\n'))
    with pytest.raises(SceneError, match=r"inputs\.load: csv .*x\.csv"):
        scene.with_values({"drive_frequency": 3000.0})
    assert scene.with_values({"drive_frequency": 3000.0, "load": 0.0}).stop_time == pytest.approx(
        20 * 3.141592653589793 / 3000.0
    )


@pytest.mark.parametrize(
    ("name", "message"),
    [
        ("table1", "did you mean 'table_1'"),
        ("no.toml", "no such scene file"),
        ("/", "is a directory; must be a scene file"),
    ],
)
def test_a_scene_that_is_not_there_is_named(name: str, message: str) -> None:
    with pytest.raises(SceneError, match=message):
        find_scene(name)


def test_a_scene_knows_the_files_it_was_read_from(tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time,load\n0,0.0\n")
    path = scene_file(tmp_path, '[inputs]\nload = { csv = "load.csv" }\n')
    assert read_scene(path).files == (path, tmp_path / "load.csv")


def test_the_refusal_of_a_scene_without_a_run_names_the_command_scenes(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"no \[run\].*the command scenes"):
        read_scene(scene_file(tmp_path, "")).schedule()


def test_a_sweep_varies_parameters_and_inputs(tmp_path: Path) -> None:
    sweep = '[sweep]\nvariable = "{}"\nvalues = [1.0, 2.0]\n'
    path = scene_file(tmp_path, "[inputs]\nload = 0.3\n" + sweep.format("load"))
    points = read_scene(path).points()
    assert [(point.at, point.scene.values["load"]) for point in points] == [
        ({"load": 1.0}, 1.0),
        ({"load": 2.0}, 2.0),
    ]
    path = scene_file(tmp_path, sweep.format("slider_mass"))
    points = read_scene(path).points()
    assert [point.scene.device.slider_mass for point in points] == [1.0, 2.0]


def test_a_swept_drive_frequency_changes_a_run_in_drive_periods(tmp_path: Path) -> None:
    sweep = '[sweep]\nvariable = "drive_frequency"\nvalues = [3500.0, 7000.0]\n'
    slow, fast = (p.scene for p in read_scene(scene_file(tmp_path, RUN + sweep)).points())
    assert slow.stop_time == 2.0 * (fast.stop_time or 0.0)
    assert slow.step_size == 2.0 * (fast.step_size or 0.0)


def test_a_scene_can_have_another_step(tmp_path: Path) -> None:
    scene = read_scene(scene_file(tmp_path, RUN))
    other = scene.with_step(1e-4)
    assert (other.step_size, other.stop_time) == (1e-4, scene.stop_time)


def test_a_swept_run_of_too_many_steps_is_refused(tmp_path: Path) -> None:
    run = "[run]\nstop_time = 1.0\nsteps_per_period = 4\n"
    sweep = '[sweep]\nvariable = "drive_frequency"\nvalues = [1e9]\n'
    with pytest.raises(SceneError, match=r"mine.toml: run: .* communication steps"):
        read_scene(scene_file(tmp_path, run + sweep)).points()


def test_a_scene_is_made_of_data_without_a_file(tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time,load\n0,0.1\n")
    content = {"name": "mine", "title": "Mine", "inputs": {"load": {"csv": "load.csv"}}}
    scene = scene_from(content, "a table", tmp_path)
    assert scene.values["load"] == 0.1
    assert (scene.source, scene.files) == ("a table", (tmp_path / "load.csv",))
    with pytest.raises(SceneError, match="a table: titel: unknown key 'titel'"):
        scene_from({"name": "mine", "titel": "Mine"}, "a table")


def test_an_allowed_error_has_an_absolute_and_a_relative_part(tmp_path: Path) -> None:
    text = RUN + "[need]\nposition = { abs = 1e-6, rel = 0.1 }\nvelocity = { abs = 2.0 }\n"
    scene = read_scene(scene_file(tmp_path, text))
    assert scene.need is not None
    assert scene.need.friction_law == "given"
    assert scene.need.needs["position"].at(-2.0) == 0.2 + 1e-6
    assert scene.need.needs["velocity"].at(5.0) == 2.0
