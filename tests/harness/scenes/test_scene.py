import math
import tomllib
from collections.abc import Sequence
from pathlib import Path

import jsonschema
import pytest

from slider_resonator.device.device import Device
from slider_resonator.errors import SceneError
from slider_resonator.scenes.json_schema import scene_schema
from slider_resonator.scenes.scene import scene_from
from slider_resonator.scenes.scene_files import find_scene
from tests.harness.scene_text import read_scene, scene_file

RUN = "[run]\ndrive_periods = 10\nsteps_per_period = 4\n"


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


def test_a_csv_can_be_held_and_its_value_column_can_be_called_value(tmp_path: Path) -> None:
    (tmp_path / "l.csv").write_text("time,value\n0,1\n0.05,2\n")
    text = '[inputs]\nload = { csv = "l.csv", between = "hold" }\n'
    load = read_scene(scene_file(tmp_path, text + RUN)).signals["load"]
    assert (load.at(0.049), load.jumps) == (1.0, (0.05,))


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


def test_a_scene_is_made_of_data_without_a_file(tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time,load\n0,0.1\n")
    content = {"name": "mine", "title": "Mine", "inputs": {"load": {"csv": "load.csv"}}}
    scene = scene_from(content, "a table", tmp_path)
    assert scene.values["load"] == 0.1
    assert (scene.source, scene.files) == ("a table", (tmp_path / "load.csv",))
    with pytest.raises(SceneError, match="a table: titel: unknown key 'titel'"):
        scene_from({"name": "mine", "titel": "Mine"}, "a table")


STEPS = "[inputs]\nload = { steps = [[0, 0], [1, 1]] }\n"
STEADY = 'quantity = "steady_velocity"\nvalue = 0.1\nrelative = 1e-6\nwhy = "test"\n'

NEEDS = {
    "": ["need: needs at least one of", "steady_velocity", "event_times"],
    "friction_law = 'free'": ["need: needs at least one of"],
    "positon = { rel = 0.1 }": ["need.positon", "did you mean 'position'?"],
    "position = {}": ["need.position", "needs a tolerance: abs, rel or both"],
    "position = 0.1": ["need.position = 0.1", "such as { rel = 0.01 }"],
    "position = { rel = 0.0 }": ["need.position.rel = 0.0", "must be a number above 0"],
    "position = { abs = -1e-6 }": ["need.position.abs = -1e-06", "a number above 0"],
    "position = { rel = nan }": ["need.position.rel = nan", "a finite number"],
    "position = { relative = 0.1 }": ["need.position.relative", "did you mean 'rel'?"],
    "friction_law = 'any'": ["need.friction_law = 'any'", "'free'"],
}
"""Needs that cannot be judged, and what is said of them."""


def assert_refused(folder: Path, text: str, parts: Sequence[str]) -> str:
    path = scene_file(folder, text)
    with pytest.raises(SceneError) as caught:
        read_scene(path)
    message = str(caught.value)
    for part in (str(path), *parts):
        assert part in message, f"{part!r} is missing in: {message}"
    return message


CSV = '{ csv = "x.csv" }\n'
RECORDED = {
    f"[inputs]\nload = {CSV}": "inputs.load",
    f"[tuning]\nnormal_preload = {CSV}": "tuning.normal_preload",
    f"[beside.inputs]\nphase = {CSV}": "beside.inputs.phase",
}
"""Tables that take the values of a CSV file, and the key that does."""


@pytest.mark.parametrize("text", RECORDED)
def test_a_csv_that_a_run_goes_beyond_is_refused(tmp_path: Path, text: str) -> None:
    (tmp_path / "x.csv").write_text("time,value\n0.01,1\n0.05,2\n")
    run = "[run]\nstop_time = {}\nstep_size = 0.01\n"
    span = "from 0.01 s to 0.05 s, must have them from 0 s to 0.05 s"
    assert_refused(tmp_path, run.format(0.05) + text, [RECORDED[text], "x.csv", span])
    (tmp_path / "x.csv").write_text("time,value\n-1,1\n0.05,2\n")
    path = scene_file(tmp_path, run.format(0.05) + text)
    assert read_scene(path).schedule().times[-1] == 0.05
    message = assert_refused(tmp_path, run.format(0.06) + text, [RECORDED[text]])
    assert "must have them from 0 s to 0.06 s, the end of the run" in message


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ('[sweep]\nvariable = "load"\nvalues = []\n', ["sweep.values", "at least 1"]),
        ("[run]\nstop_time = 1\nsteps_per_period = 1e308\n", ["run", "communication steps"]),
        ("[run]\nstop_time = 1\nstep_sizes = []\n", ["run.step_sizes", "at least 1 number"]),
        ("[run]\nstop_time = 1\nstep_sizes = [0.1, 0]\n", ["run.step_sizes[2]", "above 0"]),
        (
            "[run]\nstop_time = 1\nstep_size = 1\nstep_sizes = [1]\n",
            ["run", "step_size or steps_per_period or step_sizes"],
        ),
        (RUN + "start_time = inf\n", ["run.start_time = inf", "must be a finite number"]),
        (RUN + "read_twice = 1\n", ["run.read_twice = 1", "must be true or false"]),
        ("[tuning]\nnormal_preload = 1\n", ["tuning.normal_preload", "[run] is missing"]),
        (
            RUN + '[[expect]]\nquantity = "beside_differences"\nvalue = 0\nwhy = "x"\n',
            ["beside_differences needs a second instance", "[beside] is missing"],
        ),
        (
            RUN
            + "[tuning]\nnormal_preload = { steps = [[0, 1], [0.1, 2]] }\n[[expect]]\n"
            + 'quantity = "steady_status"\nvalue = "steady"\nwhy = "x"\n',
            ["steady_status needs constant inputs and parameters"],
        ),
        ("run = 3\n", ["run = 3", "a table"]),
        ("expect = 3\n", ["expect = 3", "headed [[expect]]"]),
        ("[inputs]\nphase = { csv = 3 }\n", ["inputs.phase.csv = 3", "a text in quotes"]),
        (
            '[inputs]\nphase = { csv = "a.csv", between = "x" }\n',
            ["inputs.phase.between = 'x'", "'linear' or 'hold'"],
        ),
        ("[inputs]\nphse = 1.0\nlod = 2.0\n", ["inputs.phse", "inputs.lod"]),
        (f"{STEPS}[[expect]]\n{STEADY}", ["needs constant inputs"]),
        *((f"{RUN}[need]\n{need}\n", parts) for need, parts in NEEDS.items()),
        ("[need]\nbeat = { rel = 0.1 }\n", ["need.beat is measured in a run: [run] is missing"]),
        (
            f"{STEPS}[need]\nblocking_force = {{ rel = 0.1 }}\n",
            ["need.blocking_force needs constant inputs"],
        ),
    ],
)
def test_a_mistake_is_named_with_key_value_and_requirement(
    tmp_path: Path, text: str, parts: list[str]
) -> None:
    message = assert_refused(tmp_path, text, parts)
    for jargon in ("Input should", "valid", "pattern", "Tuple", "dictionary", "validation"):
        assert jargon not in message, f"{jargon!r} is the schema's word: {message}"


@pytest.mark.parametrize(
    ("expect", "parts"),
    [
        (
            'quantity = "event_times"\nreference = "located_events"\nrelative = 1e-6',
            ["event_times needs a tube"],
        ),
        (
            'quantity = "position"\nreference = "averaged"\nrelative = 1e-6\ntube = 0.01',
            ["tube = 0.01", "located_events or bristle_state"],
        ),
        (
            'quantity = "position"\nreference = "located_events"\nrelative = 1e-6\ntube = 0.5',
            ["tube", "0.5", "0.25"],
        ),
        ('quantity = "steady_velocity"\nvalue = 1.0\nat_most = 2.0', ["exactly one"]),
        ('quantity = "steady_velocity"\nvalue = "fast"', ["number", "'fast'"]),
        (
            'quantity = "steady_velocity"\nvalue = true',
            ["[steady_velocity].value = True", "finite"],
        ),
        ('quantity = "steady_velocity"\nvalue = nan', ["[steady_velocity].value = nan", "finite"]),
        ('quantity = "steady_velocity"\nvalue = 0.1', ["steady_velocity", "needs a tolerance"]),
        (
            'quantity = "velocity"\nreference = "located_events"\nabsolute = 1e-6',
            ["velocity is a signal", "relative, not absolute"],
        ),
        ('quantity = "steady_status"\nat_most = 1.0', ["cannot have a bound"]),
    ],
)
def test_an_expectation_that_cannot_be_judged_is_refused(
    tmp_path: Path, expect: str, parts: list[str]
) -> None:
    assert_refused(tmp_path, f'[[expect]]\n{expect}\nwhy = "test"\n', parts)


@pytest.mark.parametrize(
    "expect",
    [
        'quantity = "reversals"\nvalue = 3',
        'quantity = "steady_status"\nvalue = "stuck"',
        'quantity = "contact_mode"\nreference = "located_events"',
        'quantity = "steady_velocity"\nat_most = 1.0',
        'quantity = "steady_velocity"\nvalue = 0.0\nabsolute = 0.0',
    ],
)
def test_counts_words_and_bounds_need_no_tolerance_and_0_is_one(
    tmp_path: Path, expect: str
) -> None:
    scene = read_scene(scene_file(tmp_path, RUN + f'[[expect]]\n{expect}\nwhy = "test"\n'))
    assert len(scene.expect) == 1
