import math
import tomllib
from pathlib import Path

import jsonschema
import pytest

from slider_resonator.device.device import Device
from slider_resonator.errors import SceneError
from slider_resonator.scenes.json_schema import scene_schema
from slider_resonator.scenes.scene import read_scenes
from tests.harness.golden import assert_mistakes_as_before
from tests.harness.scene_text import HEAD, read_scene, scene_of

RUN = "[run]\nstop_time = 0.1\nstep_size = 0.01\n"


def test_inputs_of_every_kind(tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time,load\n0,0.0\n0.1,0.05\n")
    (tmp_path / "held.csv").write_text("time,value\n0,1\n0.05,2\n0.1,3\n")
    text = """
    [inputs]
    phase = { steps = [[0, 0], [0.017, 0.4]] }
    load = { csv = "load.csv" }
    frequency_ratio = { ramp = [[0, 1], [1, 2]] }
    [tuning]
    normal_preload = { csv = "held.csv", between = "hold" }
    """
    scene = scene_of(text + RUN, tmp_path)
    signals = scene.signals
    assert signals["phase"].at(0.017) == 0.4
    assert signals["load"].at(0.05) == pytest.approx(0.025)
    assert signals["frequency_ratio"].at(0.5) == pytest.approx(1.5)
    assert 0.017 in scene.schedule().times, "a step of an input is a communication point"
    held = scene.tuning["normal_preload"]
    assert (held.at(0.049), held.jumps) == (1.0, (0.05, 0.1))
    assert scene.files == (tmp_path / "load.csv", tmp_path / "held.csv")


def test_values_may_have_a_unit() -> None:
    text = """
    [inputs]
    phase = "30 deg"
    load = { steps = [[0.0, "0 N"], ["1 ms", "50 mN"]] }
    [tuning]
    drive_frequency = { ramp = [[0.0, "20 kHz"], ["2 ms", 130e3]] }
    [device]
    slider_mass = "5 g"
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
    jsonschema.validate(tomllib.loads(HEAD + text), scene_schema())
    scene = scene_of(text)
    assert scene.signals["phase"].at(0.0) == pytest.approx(math.pi / 6.0)
    assert (scene.signals["load"].times, scene.signals["load"].values) == ((0.0, 1e-3), (0.0, 0.05))
    assert scene.tuning["drive_frequency"].values == pytest.approx((40e3 * math.pi, 130e3))
    assert scene.parameters["slider_mass"] == 0.005
    assert scene.run is not None
    assert (scene.stop_time, scene.run.step_sizes) == (2e-3, (1e-5, 2e-5))
    assert scene.expect[0].at_most == 1e-3
    assert scene.need is not None
    assert scene.need.position is not None
    assert (scene.need.position.abs, scene.need.position.rel) == pytest.approx((1e-6, 0.01))
    assert scene.sweep is not None
    assert scene.sweep.values == (0.1, 0.05)


def test_tuned_parameters_start_as_the_tuning_says_and_a_value_replaces_it() -> None:
    scene = scene_of(RUN + "[tuning]\nnormal_preload = { steps = [[0, 2.0], [0.017, 3.0]] }\n")
    assert scene.device.normal_preload == 2.0
    schedule = scene.schedule()
    assert 0.017 in schedule.times, "a step of a parameter is a communication point"
    devices = [scene.device.tuned(inputs.tuned) for inputs in schedule.held()]
    assert [device.normal_preload for device in devices] == [2.0, 3.0]
    replaced = scene.with_values({"normal_preload": 5.0})
    assert replaced.device.normal_preload == 5.0
    assert not replaced.schedule().tuning


DEVIATING = RUN + "[inputs]\nfrequency_deviation = 0.1\n"


def test_a_constant_deviation_is_that_of_the_device() -> None:
    scene = scene_of(DEVIATING)
    assert scene.parameters == {"frequency_deviation": 0.1}
    assert scene.device == Device(drive_frequency=3500.0 * 1.1)
    assert not scene.tuning


def test_deviations_over_time_are_of_what_the_drive_is_tuned_to() -> None:
    deviation = "amplitude_deviation = { steps = [[0.0, -1.0], [0.05, 0.5]] }\n"
    tuning = "[tuning]\nbase_amplitude = { steps = [[0.0, 1e-4], [0.07, 2e-4]] }\n"
    scene = scene_of(DEVIATING + deviation + tuning)
    assert scene.device == Device(), "that of the parameters"
    found = [scene.device.tuned(held.tuned) for held in scene.schedule().held()]
    assert [d.base_amplitude for d in found] == [0.0, 1e-4 * 1.5, 2e-4 * 1.5]
    assert [d.drive_frequency for d in found] == [3500.0 * 1.1] * 3
    off = scene.with_values({"amplitude_deviation": -0.5})
    found = [off.device.tuned(held.tuned) for held in off.schedule().held()]
    assert [d.base_amplitude for d in found] == [0.5e-4, 1e-4]


def test_the_refusal_of_a_scene_without_a_run_names_the_command_scenes() -> None:
    with pytest.raises(SceneError, match=r"no \[run\].*the command scenes"):
        scene_of("").schedule()


@pytest.mark.parametrize(
    ("name", "head"),
    [
        ("mistakes_in_the_head.txt", ""),
        ("mistakes.txt", HEAD),
        # These depend on other tables, files or numbers in a way that a schema cannot say.
        ("mistakes_beyond_the_schema.txt", HEAD),
    ],
)
def test_mistakes_are_explained(tmp_path: Path, name: str, head: str) -> None:
    (tmp_path / "short.csv").write_text("time,load\n0,0\n0.05,1\n")
    (tmp_path / "late.csv").write_text("time,load\n0.01,1\n0.1,2\n")
    (tmp_path / "bare.csv").write_text("0,0\n1,1\n")
    (tmp_path / "words.csv").write_text("time,load\n0,none\n")
    (tmp_path / "twice.csv").write_text("time,load,load\n0,0,1\n0.1,1,2\n")
    (tmp_path / "utf16.csv").write_bytes("time,load\n0,0\n1,1\n".encode("utf-16")[:-1])
    assert_mistakes_as_before(name, tmp_path / "mine.toml", read_scenes, head)


def test_a_scene_saved_with_a_byte_order_mark_is_read(tmp_path: Path) -> None:
    path = tmp_path / "mine.toml"
    path.write_text(f"{HEAD}[run]\nstop_time = 0.1\nstep_size = 0.01\n", encoding="utf-8-sig")
    assert read_scene(path).name == "mine"
