from __future__ import annotations

import pickle
from collections.abc import Sequence
from pathlib import Path

import pytest

from slider_resonator.device.interface import TUNABLES
from slider_resonator.errors import SceneError
from slider_resonator.scenes.input_tables import TuningTable
from slider_resonator.scenes.scene import read_scene, scene_from
from slider_resonator.scenes.scene_files import built_in_scenes, find_scene

HEAD = 'name = "mine"\ntitle = "Mine"\n'
STEPS = "[inputs]\nload = { steps = [[0, 0], [1, 1]] }\n"
STEADY = 'quantity = "steady_velocity"\nvalue = 0.1\nrelative = 1e-6\nwhy = "test"\n'
RUN = "[run]\ndrive_periods = 10\nsteps_per_period = 4\n"

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


def write(folder: Path, text: str) -> Path:
    path = folder / "mine.toml"
    path.write_text(text)
    return path


def assert_refused(folder: Path, text: str, parts: Sequence[str]) -> str:
    path = write(folder, text)
    with pytest.raises(SceneError) as caught:
        read_scene(path)
    message = str(caught.value)
    for part in (str(path), *parts):
        assert part in message, f"{part!r} is missing in: {message}"
    return message


@pytest.mark.parametrize("name", built_in_scenes())
def test_built_in_scenes_are_sound_and_named_as_their_file(name: str) -> None:
    scene = read_scene(find_scene(name))
    assert scene.name == name
    assert scene.title
    assert scene.description
    assert scene.expect, "a built-in scene must expect something"
    assert all(expect.why for expect in scene.expect)


def test_the_scenes_that_the_paper_calls_for_are_built_in() -> None:
    assert set(built_in_scenes()) >= {
        *("table_1", "table_1_high_frequency", "phase_sweep", "load_speed", "blocking_force"),
        *("ratio_3", "detuned_beat", "pushed_at_rest", "lift_off", "changing_inputs"),
    }


def test_a_scene_of_a_name_and_a_title_is_table_1(tmp_path: Path) -> None:
    scene = read_scene(write(tmp_path, HEAD + RUN))
    assert scene.device.base_amplitude == 1e-4
    assert scene.values == {"phase": 0.0, "load": 0.0, "frequency_ratio": 1.0}
    schedule = scene.schedule()
    assert len(schedule.times) == 41
    assert schedule.times[-1] == pytest.approx(10 * 2 * 3.141592653589793 / 3500)


def test_inputs_of_every_kind(tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time,load\n0,0.0\n0.1,0.05\n")
    scene = read_scene(
        write(
            tmp_path,
            HEAD
            + '[inputs]\nphase = { steps = [[0, 0], [0.01, 0.4]] }\nload = { csv = "load.csv" }\n'
            "frequency_ratio = { ramp = [[0, 1], [1, 2]] }\n"
            "[run]\nstop_time = 0.1\nstep_size = 0.007\n",
        )
    )
    signals = scene.signals
    assert signals["phase"].at(0.01) == 0.4
    assert signals["load"].at(0.05) == pytest.approx(0.025)
    assert signals["frequency_ratio"].at(0.5) == pytest.approx(1.5)
    assert 0.01 in scene.schedule().times, "a step of an input is a communication point"


def test_tuned_parameters_start_as_the_tuning_says_and_a_value_replaces_it(tmp_path: Path) -> None:
    text = "[tuning]\nnormal_preload = { steps = [[0, 2.0], [0.01, 3.0]] }\n"
    scene = read_scene(write(tmp_path, HEAD + RUN + text))
    assert scene.device.normal_preload == 2.0
    schedule = scene.schedule()
    assert 0.01 in schedule.times, "a step of a parameter is a communication point"
    devices = [inputs.tuned_device(scene.device) for inputs in schedule.held()]
    assert [device.normal_preload for device in devices] == [2.0, 3.0]
    replaced = scene.with_values({"normal_preload": 5.0})
    assert replaced.device.normal_preload == 5.0
    assert not replaced.schedule().tuning


def test_commands_that_ignore_the_tuning_refuse_it(tmp_path: Path) -> None:
    run = "[run]\nstop_time = 1.0\nstep_sizes = [0.1, 0.2]\nstart_time = 3.0\n"
    scene = read_scene(write(tmp_path, HEAD + run))
    with pytest.raises(SceneError, match="trade takes no scene with run"):
        scene.check_plain("trade")
    read_scene(write(tmp_path, HEAD + RUN)).check_plain("trade")


def test_every_tunable_parameter_has_a_key() -> None:
    assert tuple(TuningTable.model_fields) == TUNABLES


def test_a_csv_can_be_held_and_its_value_column_can_be_called_value(tmp_path: Path) -> None:
    (tmp_path / "l.csv").write_text("time,value\n0,1\n0.05,2\n")
    text = '[inputs]\nload = { csv = "l.csv", between = "hold" }\n'
    load = read_scene(write(tmp_path, HEAD + text + RUN)).signals["load"]
    assert (load.at(0.049), load.jumps) == (1.0, (0.05,))


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
    assert_refused(tmp_path, HEAD + run.format(0.05) + text, [RECORDED[text], "x.csv", span])
    (tmp_path / "x.csv").write_text("time,value\n-1,1\n0.05,2\n")
    path = write(tmp_path, HEAD + run.format(0.05) + text)
    assert read_scene(path).schedule().times[-1] == 0.05
    message = assert_refused(tmp_path, HEAD + run.format(0.06) + text, [RECORDED[text]])
    assert "must have them from 0 s to 0.06 s, the end of the run" in message


def test_a_slower_drive_may_make_a_run_longer_than_its_csv(tmp_path: Path) -> None:
    (tmp_path / "x.csv").write_text("time,load\n0,0\n0.018,1\n")
    scene = read_scene(write(tmp_path, HEAD + RUN + f"[inputs]\nload = {CSV}"))
    with pytest.raises(SceneError, match=r"inputs\.load: csv .*x\.csv"):
        scene.with_values({"drive_frequency": 3000.0})
    assert scene.with_values({"drive_frequency": 3000.0, "load": 0.0}).stop_time == pytest.approx(
        20 * 3.141592653589793 / 3000.0
    )


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        ("[device]\nslider_mass = true\n", ["device.slider_mass", "True", "must be a number"]),
        ("[device]\nfriction_faces = 1.5\n", ["friction_faces", "1.5", "integer"]),
        ('[inputs]\nphase = "1"\n', ["inputs.phase", "'1'", "must be a number"]),
        (
            "[inputs]\nphase = { steps = [[0, 1, 2]] }\n",
            ["inputs.phase.steps[0]", "a pair [time (s), value]"],
        ),
        ("[inputs]\nphase = { step = [[0, 0]] }\n", ["inputs.phase.step", "'steps'"]),
        ("[inputs]\nphase = {}\n", ["inputs.phase", "exactly one"]),
        ("[run]\nstop_time = 1.0\n", ["run", "step_size or steps_per_period"]),
        ("[run]\nstop_time = -1.0\nstep_size = 0.1\n", ["run.stop_time", "-1.0", "above 0"]),
        ('[sweep]\nvariable = "load"\nvalues = []\n', ["sweep.values", "at least one"]),
        ('[sweep]\nvariable = "fidelity"\nvalues = [1.5]\n', ["sweep", "1.5", "an integer"]),
        ("[device]\ndrive_frequency = 0\n", ["device", "drive_frequency = 0.0", "above 0"]),
        ("[run]\nstop_time = 1e9\nstep_size = 1e-4\n", ["run", "1e+09", "1e+13", "3000000"]),
        ("[run]\nstop_time = 1\nsteps_per_period = 1e308\n", ["run", "communication steps"]),
        ("device = 3\n", ["device = 3", "a table"]),
        ("[run]\nstop_time = 1\nstep_sizes = []\n", ["run.step_sizes", "at least 1 number"]),
        ("[run]\nstop_time = 1\nstep_sizes = [0.1, 0]\n", ["run.step_sizes[1]", "above 0"]),
        (
            "[run]\nstop_time = 1\nstep_size = 1\nstep_sizes = [1]\n",
            ["run", "step_size or steps_per_period or step_sizes"],
        ),
        (RUN + "start_time = inf\n", ["run.start_time = inf", "must be a finite number"]),
        (RUN + "read_twice = 1\n", ["run.read_twice = 1", "must be true or false"]),
        (RUN + "[tuning]\nnormal_prelod = 1\n", ["tuning", "did you mean 'normal_preload'?"]),
        (RUN + "[tuning]\nnormal_preload = {}\n", ["tuning.normal_preload", "exactly one"]),
        (
            RUN + "[tuning]\nnormal_preload = { steps = [[1, 0], [0, 1]] }\n",
            ["tuning.normal_preload", "increase"],
        ),
        (
            RUN + "[tuning]\ndrive_frequency = { steps = [[0, 1], [1, 0]] }\n",
            ["drive_frequency = 0.0", "above 0"],
        ),
        ("[tuning]\nnormal_preload = 1\n", ["tuning.normal_preload", "[run] is missing"]),
        ("[beside.device]\nslider_mas = 1\n", ["beside.device", "'slider_mass'"]),
        ("[beside.inputs]\nphse = 1\n", ["beside.inputs.phse", "'phase'"]),
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
        ("[inputs]\nphase = { steps = 3 }\n", ["inputs.phase.steps = 3", "a list"]),
        ("[inputs]\nphase = { csv = 3 }\n", ["inputs.phase.csv = 3", "a text in quotes"]),
        (
            '[inputs]\nphase = { csv = "a.csv", between = "x" }\n',
            ["inputs.phase.between = 'x'", "'linear' or 'hold'"],
        ),
        ("[inputs]\nphse = 1.0\nlod = 2.0\n", ["inputs.phse", "inputs.lod"]),
        (f"{STEPS}[[expect]]\n{STEADY}", ["needs constant inputs"]),
        *((f"{RUN}[need]\n{need}\n", parts) for need, parts in NEEDS.items()),
        (
            "[need]\nbeat = { rel = 0.1 }\n",
            ["need.beat is measured in a run: [run] is missing"],
        ),
        (
            f"{STEPS}[need]\nblocking_force = {{ rel = 0.1 }}\n",
            ["need.blocking_force needs constant inputs"],
        ),
    ],
)
def test_a_mistake_is_named_with_key_value_and_requirement(
    tmp_path: Path, text: str, parts: list[str]
) -> None:
    message = assert_refused(tmp_path, HEAD + text, parts)
    for jargon in ("Input should", "valid", "pattern", "Tuple", "dictionary", "validation"):
        assert jargon not in message, f"{jargon!r} is the schema's word: {message}"


@pytest.mark.parametrize(
    ("expect", "parts"),
    [
        ('quantity = "velocity"\nvalue = 1.0', ["signal", "needs a reference"]),
        (
            'quantity = "event_times"\nreference = "taylor"\nrelative = 1e-6',
            ["event_times needs a tube"],
        ),
        (
            'quantity = "position"\nreference = "averaged"\nrelative = 1e-6\ntube = 0.01',
            ["tube = 0.01", "located_events or taylor or bristle_state"],
        ),
        (
            'quantity = "position"\nreference = "taylor"\nrelative = 1e-6\ntube = 0.5',
            ["tube", "0.5", "0.25"],
        ),
        ('quantity = "steady_velocity"\nvalue = 1.0\nat_most = 2.0', ["exactly one"]),
        ('quantity = "steady_velocity"\nvalue = "fast"', ["number", "'fast'"]),
        ('quantity = "steady_velocity"\nvalue = true', ["expect[0].value = True", "finite number"]),
        ('quantity = "steady_velocity"\nvalue = nan', ["expect[0].value = nan", "finite number"]),
        ('quantity = "steady_velocity"\nvalue = 0.1', ["steady_velocity", "needs a tolerance"]),
        ('quantity = "velocity"\nreference = "taylor"', ["velocity", "a share of the peak"]),
        (
            'quantity = "velocity"\nreference = "taylor"\nabsolute = 1e-6',
            ["velocity is a signal", "relative, not absolute"],
        ),
        ('quantity = "steady_status"\nat_most = 1.0', ["cannot have a bound"]),
    ],
)
def test_an_expectation_that_cannot_be_judged_is_refused(
    tmp_path: Path, expect: str, parts: list[str]
) -> None:
    assert_refused(tmp_path, HEAD + f'[[expect]]\n{expect}\nwhy = "test"\n', parts)


@pytest.mark.parametrize(
    "expect",
    [
        'quantity = "reversals"\nvalue = 3',
        'quantity = "steady_status"\nvalue = "stuck"',
        'quantity = "contact_mode"\nreference = "taylor"',
        'quantity = "steady_velocity"\nat_most = 1.0',
        'quantity = "steady_velocity"\nvalue = 0.0\nabsolute = 0.0',
    ],
)
def test_counts_words_and_bounds_need_no_tolerance_and_0_is_one(
    tmp_path: Path, expect: str
) -> None:
    scene = read_scene(write(tmp_path, HEAD + RUN + f'[[expect]]\n{expect}\nwhy = "test"\n'))
    assert len(scene.expect) == 1


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
    path = write(tmp_path, HEAD + '[inputs]\nload = { csv = "load.csv" }\n')
    assert read_scene(path).files == (path, tmp_path / "load.csv")


def test_the_refusal_of_a_scene_without_a_run_names_the_command_scenes(tmp_path: Path) -> None:
    with pytest.raises(SceneError, match=r"no \[run\].*the command scenes"):
        read_scene(write(tmp_path, HEAD)).schedule()


def test_a_sweep_varies_parameters_and_inputs(tmp_path: Path) -> None:
    sweep = '[sweep]\nvariable = "{}"\nvalues = [1.0, 2.0]\n'
    path = write(tmp_path, HEAD + "[inputs]\nload = 0.3\n" + sweep.format("load"))
    points = read_scene(path).points()
    assert [(point.at, point.scene.values["load"]) for point in points] == [
        ({"load": 1.0}, 1.0),
        ({"load": 2.0}, 2.0),
    ]
    path = write(tmp_path, HEAD + sweep.format("slider_mass"))
    points = read_scene(path).points()
    assert [point.scene.device.slider_mass for point in points] == [1.0, 2.0]


def test_a_swept_drive_frequency_changes_a_run_in_drive_periods(tmp_path: Path) -> None:
    sweep = '[sweep]\nvariable = "drive_frequency"\nvalues = [3500.0, 7000.0]\n'
    slow, fast = (p.scene for p in read_scene(write(tmp_path, HEAD + RUN + sweep)).points())
    assert slow.stop_time == 2.0 * (fast.stop_time or 0.0)
    assert slow.step_size == 2.0 * (fast.step_size or 0.0)


def test_a_scene_can_have_another_step(tmp_path: Path) -> None:
    scene = read_scene(write(tmp_path, HEAD + RUN))
    other = scene.with_step(1e-4)
    assert (other.step_size, other.stop_time) == (1e-4, scene.stop_time)


def test_a_swept_run_of_too_many_steps_is_refused(tmp_path: Path) -> None:
    run = "[run]\nstop_time = 1.0\nsteps_per_period = 4\n"
    sweep = '[sweep]\nvariable = "drive_frequency"\nvalues = [1e9]\n'
    with pytest.raises(SceneError, match=r"mine.toml: run: .* communication steps"):
        read_scene(write(tmp_path, HEAD + run + sweep)).points()


@pytest.mark.parametrize("name", built_in_scenes())
def test_a_scene_is_data_that_can_be_sent_to_another_process(name: str) -> None:
    scene = read_scene(find_scene(name))
    assert pickle.loads(pickle.dumps(scene)) == scene


def test_a_scene_is_made_of_data_without_a_file(tmp_path: Path) -> None:
    (tmp_path / "load.csv").write_text("time,load\n0,0.1\n")
    content = {"name": "mine", "title": "Mine", "inputs": {"load": {"csv": "load.csv"}}}
    scene = scene_from(content, "a table", tmp_path)
    assert scene.values["load"] == 0.1
    assert (scene.source, scene.files) == ("a table", (tmp_path / "load.csv",))
    with pytest.raises(SceneError, match="a table: titel: unknown key 'titel'"):
        scene_from({"name": "mine", "titel": "Mine"}, "a table")


def test_an_allowed_error_has_an_absolute_and_a_relative_part(tmp_path: Path) -> None:
    text = HEAD + RUN + "[need]\nposition = { abs = 1e-6, rel = 0.1 }\nvelocity = { abs = 2.0 }\n"
    scene = read_scene(write(tmp_path, text))
    assert scene.need is not None
    assert scene.need.friction_law == "given"
    assert scene.need.needs["position"].at(-2.0) == 0.2 + 1e-6
    assert scene.need.needs["velocity"].at(5.0) == 2.0
