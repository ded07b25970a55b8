"""The Python API: what the commands do, for scripts."""

import sys
import tomllib
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any, cast

import numpy as np
import pytest
from fmpy import simulate_fmu
from pydantic import ValidationError

import slider_resonator as sr
from slider_resonator.fmu import finished
from slider_resonator.output.plot_style import Picture
from slider_resonator.trading import peer_methods
from tests.harness.verdicts import BAD, SLOWER

STEADY_VELOCITY = 0.0986951
"""Of table 1 at phase 0.4 rad and a load of 0.05 N, by Taylor integration, m/s."""
SHORT: dict[str, Any] = {"run": {"stop_time": 0.1, "step_size": 0.01}}


def test_every_name_of_the_api_is_one_of_the_package() -> None:
    from slider_resonator import api

    assert sr.__all__ == api.__all__
    assert all(getattr(sr, name) is getattr(api, name) for name in sr.__all__)
    assert set(sr.__all__) <= set(dir(sr))
    with pytest.raises(AttributeError, match="no attribute 'velocity'"):
        _ = sr.velocity


def test_an_open_fmu_runs_scenes_and_is_searched(native_fmu: Path) -> None:
    with sr.open_fmu(native_fmu) as fmu:
        record = fmu.run(
            {"run": {"stop_time": 0.5, "step_size": 0.01}, "inputs": {"phase": {"constant": 0.4}}},
            load=0.05,
        )
        motion = fmu.steady(phase=0.4, load=0.05)
        blocking = fmu.blocking()
    expected = simulate_fmu(
        str(native_fmu),
        start_values={"phase": 0.4, "load": 0.05},
        output=["mean_velocity"],
        stop_time=0.5,
        output_interval=0.01,
    )
    assert record.times == pytest.approx(expected["time"])
    assert np.abs(record["mean_velocity"] - expected["mean_velocity"]).max() < 1e-12
    assert motion.status == "steady"
    assert motion.steady_velocity == pytest.approx(STEADY_VELOCITY, abs=5e-8)
    assert blocking.blocking_force == pytest.approx(0.0851861, abs=5e-8)


def test_scenes_are_names_files_and_data(native_fmu: Path, tmp_path: Path) -> None:
    built_in = sr.read_scene("table_1", load=0.01)
    assert built_in.values["load"] == 0.01
    assert built_in.title == "The device of table 1, load replaced"
    assert sr.read_scene(built_in, load=0.02).values["load"] == 0.02
    named = "blocking_force_table_1"
    for scenes in (named, [named], sr.read_scene(named)):
        (validation,) = sr.validate(native_fmu, scenes=scenes)
        assert validation.passed
        assert {check.scene for check in validation.checks} == {named}
    value = {"quantity": "steady_velocity", "value": STEADY_VELOCITY, "relative": 1e-6, "why": "-"}
    inputs = {"phase": 0.4, "load": 0.05}
    (validation,) = sr.validate(native_fmu, scenes=[{"inputs": inputs, "expect": [value]}])
    assert validation.passed, "a scene as data"
    table = tmp_path / "table.csv"
    table.write_text("point,phase\n0,1.0\n")
    grid = {"measures": ["steady_velocity"], "list": {"phase": [0.0, 0.4]}}
    with pytest.raises(sr.HarnessError, match="exists; must be a new file"):
        sr.sweep(grid, table, native_fmu, workers=1)
    result = sr.sweep(grid, table, native_fmu, workers=1, overwrite=True)
    assert (result.points, result.failed) == (2, 0)
    assert table.read_text().count("\n") == 3


def test_what_a_script_gets_wrong_is_named(native_fmu: Path) -> None:
    with sr.open_fmu(native_fmu) as fmu:
        with pytest.raises(sr.HarnessError, match=r"phase = '0\.4 kg': not in rad; must be"):
            fmu.steady(phase="0.4 kg")
        with pytest.raises(sr.HarnessError, match=r"load = '50 mN': it is what is searched; must"):
            fmu.blocking(load="50 mN")
        with pytest.raises(sr.HarnessError, match=r"friction_coefficient = 0\.0 refused: with"):
            fmu.run("table_1", friction_law=1, friction_coefficient=0.0)
        record = fmu.run(SHORT)
    for read in (record.__getitem__, record.final):
        with pytest.raises(sr.HarnessError, match="unknown column 'positon'; did you mean 'pos"):
            read("positon")


def test_finished_fmus_are_found(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(finished, "FOLDERS", (tmp_path,))
    with pytest.raises(sr.HarnessError, match="in a checkout `make build` builds it"):
        sr.fmu_path()
    for build, name in finished.FMUS.items():
        (tmp_path / name).touch()
        assert sr.fmu_path(build) == tmp_path / name
    with pytest.raises(sr.HarnessError, match="'fmi2': must be one of 'native', 'python', 'fmi3'"):
        sr.fmu_path("fmi2")  # type: ignore[arg-type]


def test_results_say_what_was_found_on_a_screen(native_fmu: Path, tmp_path: Path) -> None:
    with sr.open_fmu(native_fmu, device={"slider_mass": "2 kg"}) as fmu:
        record, motion = fmu.run("table_1"), fmu.steady(phase=0.4)
        blocking = fmu.blocking()
    grid = {"amplitude_deviation": np.linspace(0.0, 1.0, 3)}
    task = {"measures": ["steady_velocity"], "grid": grid}
    table = sr.sweep(task, tmp_path / "table.csv", native_fmu, workers=1)
    (validation,) = sr.validate(native_fmu, scenes=["blocking_force_table_1"])
    choice = sr.choose(fmu=native_fmu, need={"position": "1 %"}, time="50 ms", step="5 ms")
    assert choice.step == 5e-3
    measured = {"phase [deg]": np.array([0.0]), "velocity [mm/s]": [120.0]}
    frame: Any = SimpleNamespace(to_dict=lambda orient: {"list": measured}[orient])
    fit = sr.fit(frame, "friction_coefficient", native_fmu)
    scene = sr.read_scene("table_1")
    for result, words in (
        (record, f"mean_velocity           {record.final('mean_velocity'):.9g} m/s"),
        (motion, f"{motion.steady_velocity:.10g} m/s"),
        (blocking, f"{blocking.blocking_force:.10g} N"),
        (blocking, "on 2 faces"),
        (table, "amplitude_deviation 0 to 1"),
        (table, f"{min(table.columns['steady_velocity']):.6g} to"),
        (validation, f"pass: {len(validation.checks)} of {len(validation.checks)} checks"),
        (choice, choice.model.name),
        (fit, f"{fit.parameters[0].value:.8g}"),
        (scene, "table_1: The device of table 1"),
        (fit.device, "Device(friction_coefficient="),
    ):
        text = repr(result)
        assert words in text
        assert text.count("\n") <= 25
        assert max(map(len, text.splitlines())) < 300
    picture = tmp_path / "run.png"
    assert isinstance(record.plot(picture), Picture), "a notebook shows it"
    assert picture.read_bytes().startswith(b"\x89PNG")
    for drawable in (table, fit):
        assert isinstance(drawable.plot(), Picture)
    with pytest.raises(sr.HarnessError, match=r"the suffix is '\.gif'; must be one of \.png"):
        record.plot(tmp_path / "run.gif")
    for tabular in (record, table, fit, validation, choice):
        assert len({len(column) for column in tabular.table().values()}) == 1


def test_tables_go_to_pandas(native_fmu: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    with sr.open_fmu(native_fmu) as fmu:
        record = fmu.run(SHORT)
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(sr.HarnessError, match="needs pandas: pip install pandas"):
        record.to_pandas()
    monkeypatch.setitem(sys.modules, "pandas", SimpleNamespace(DataFrame=dict))
    frame = record.to_pandas()
    assert list(frame)[:4] == ["time", "phase", "load", "frequency_ratio"]
    assert frame["position"] is record["position"]


def test_arrays_and_numbers_of_numpy_are_data(native_fmu: Path, tmp_path: Path) -> None:
    points = np.array([[0.0, 0.0], [0.05, 0.02]])
    scene = sr.read_scene(
        {
            "run": {"stop_time": np.float32(0.5), "step_size": np.float64(0.01)},
            "device": {"friction_law": np.int64(1)},
            "inputs": {"load": {"steps": points}, "phase": {"ramp": tuple(points)}},
        },
        damping_ratio=np.float32(0.5),
    )
    assert scene.signals["load"].values == (0.0, 0.02)
    assert scene.parameters == {"friction_law": 1.0, "damping_ratio": 0.5}
    assert {type(value) for value in scene.parameters.values()} == {float, int}
    grid = {
        "measures": ("steady_velocity",),
        "grid": {"friction_law": range(2), "phase": np.arange(2)},
        "fixed": {"load": np.float64(0.01)},
    }
    result = sr.sweep(grid, tmp_path / "table.csv", native_fmu, workers=1)
    assert (result.points, result.failed) == (4, 0)


wrong: Any = 3


@pytest.mark.parametrize(
    ("call", "text"),
    [
        (lambda: sr.read_scene("table_1", phase=float("nan")), "phase = nan: must be a"),
        (lambda: sr.read_scene("table_1", phse=1.0), "did you mean 'phase'"),
        (lambda: sr.read_scene({"run": {"stop_time": "a"}}), r"scene: run\.stop_time = 'a': must"),
        (lambda: sr.read_device({"slider_mass": -1}), r"device\.slider_mass = -1: must be a"),
        (lambda: sr.read_device({"drive_frequency": "20 kHzz"}), "drive_frequency"),
        (lambda: sr.Device(slider_mass=-1.0), "slider_mass = -1.0: must be a finite number of at"),
        (lambda: sr.Device(friction_faces=3), "friction_faces = 3: must be an integer"),
        (lambda: sr.read_device("no.toml"), r"no\.toml: cannot be read: No such file"),
        (lambda: sr.open_fmu("no.fmu", time_limit=0), "time_limit = 0: must be a number above 0"),
        (lambda: sr.validate("no.fmu", scenes="table_1", jobs=0), "jobs = 0: must be a number ab"),
        (lambda: sr.validate("no.fmu", scenes=[]), "must be at least one scene"),
        (lambda: sr.choose("table_1", "no.fmu", need={"positon": 1e-6}), "did you mean 'position'"),
        (lambda: sr.choose("table_1", "no.fmu", time=-1), "time = '-1': must be above 0 s, and"),
        (lambda: sr.sweep({"grid": {"phase": 3}}, "a.csv"), r"grid\.phase = 3: must be a list"),
        (lambda: sr.fit("no.csv", "damping_ratio"), r"no\.csv cannot be read"),
        (lambda: sr.fit({"phase": [0], "force": [1, 2]}, "damping_ratio"), "must be columns of"),
        (lambda: sr.fit({"fase": [0]}, "damping_ratio"), "data: unknown column 'fase'; did you"),
        (lambda: sr.fit({}, "damping_ratio"), "data: must be columns of one"),
        (lambda: sr.to_toml("no.toml"), r"no\.toml: cannot be read: No such file"),
        (lambda: sr.validate(wrong), "fmu = 3: must be a path"),
        (lambda: sr.validate(scenes=wrong), "unknown scene '3'"),
        (lambda: sr.choose(need=wrong), "need = 3: must be errors by quantity"),
        (lambda: sr.fit(wrong, "damping_ratio"), "data = 3: must be a file, columns, or"),
        (lambda: sr.fit("no.csv", wrong), "free = 3: must be names of parameters"),
        (lambda: sr.fit("no.csv", "load", bounds=wrong), "bounds = 3: must be lowest and highest"),
    ],
)
def test_bad_arguments_are_one_line(call: Callable[[], object], text: str) -> None:
    with pytest.raises(sr.HarnessError, match=text) as caught:
        call()
    assert "\n" not in str(caught.value)
    assert not isinstance(caught.value.__cause__, ValidationError), "pydantic is not shown"


def test_a_device_may_be_given_with_units(native_fmu: Path) -> None:
    text: Any = "0.2 mm"  # as annotated, a Device has numbers
    for device in ({"base_amplitude": text}, sr.Device(base_amplitude=text)):
        assert sr.read_device(device) == sr.Device(base_amplitude=2e-4)
        with sr.open_fmu(native_fmu, device=device) as fmu:
            record = fmu.run("table_1")
        assert record.scene.parameters["base_amplitude"] == 2e-4


def test_a_device_of_any_numbers_is_written_as_plain_ones() -> None:
    mass: Any = "50 g"
    faces: Any = np.int64(1)
    mine = sr.Device(slider_mass=mass, friction_faces=faces, damping_ratio=np.float64(0.02))
    content = tomllib.loads(sr.to_toml(mine))
    assert content["device"] == {"slider_mass": 0.05, "friction_faces": 1, "damping_ratio": 0.02}
    assert sr.to_toml("table_1") == sr.to_toml({}) == "[device]\nfriction_faces = 2\n"


def test_what_a_device_file_states_replaces_the_scene(native_fmu: Path, tmp_path: Path) -> None:
    """Also where it is the value of table 1, as with the commands."""
    mine = tmp_path / "mine.toml"
    mine.write_text('[device]\nslider_mass = "1 kg"\nresonator_mass = 0.2\n', encoding="utf-8")
    scene = {**SHORT, "device": {"slider_mass": 3.0}}
    with sr.open_fmu(native_fmu, device=mine) as fmu:
        assert fmu.run(scene).scene.device.slider_mass == 1.0
        expected = fmu.steady(phase=0.4).steady_velocity
    grid = {"grid": {"phase": [0.4]}}
    table = sr.sweep(grid, tmp_path / "a.csv", native_fmu, device=mine, workers=1)
    assert table.columns["steady_velocity"] == pytest.approx([expected], rel=1e-9)


def test_device_replaces_that_of_scene(native_fmu: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """In a choice, too, as with the commands: what it leaves out is that of table 1."""
    monkeypatch.setattr("slider_resonator.api.choose_model", lambda scene, fmu: scene)
    scene = {**SHORT, "device": {"damping_ratio": 0.3, "tolerance": 1e-6}}
    read = cast(sr.Scene, sr.choose(scene, native_fmu, device={"slider_mass": 2.0}, load=0.01))
    assert read.parameters == {"tolerance": 1e-6, "slider_mass": 2.0}
    assert read.values["load"] == 0.01
    need: dict[str, Any] = {"mean_velocity": "2 %", "position": "3 um", "velocity": 0.01}
    read = cast(sr.Scene, sr.choose(scene, native_fmu, need=need, time="20 ms"))
    assert read.stop_time == 0.02
    assert read.need is not None
    assert list(read.need.needs) == list(need)
    assert [(error.abs, error.rel) for error in read.need.needs.values()] == [
        (None, 0.02),
        (3e-6, None),
        (0.01, None),
    ]


def test_stress_is_a_function(native_fmu: Path) -> None:
    (stressed,) = sr.stress(native_fmu, random=1, jobs=1)
    assert stressed.passed
    assert len(stressed.table()["verdict"]) == 1
    with pytest.raises(sr.HarnessError, match="random = 2 and device = 'lugre_steel': must be"):
        sr.stress(native_fmu, random=2, device="lugre_steel")


def test_trade_is_a_function(native_fmu: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    # At rest sgn chatters: the peer that integrates it gives up earlier.
    monkeypatch.setattr(peer_methods, "MAX_EVALUATIONS", 2000)
    scene = {
        "name": "ramped",
        "title": "Inputs that vary have no steady velocity to be searched for",
        "run": {"drive_periods": 4, "steps_per_period": 4},
        "inputs": {"load": {"ramp": [[0.0, 0.0], [0.007, 0.05]]}},
    }
    (measured,) = sr.trade(scene, native_fmu, periods=2, repeats=1, budget=0.01)
    assert len(measured.table()["method"]) == len(measured.rows) > 0
    assert "at an error of 1 % in mean velocity" in repr(measured)


def test_lines_that_do_not_fit_a_screen_are_counted() -> None:
    lines = repr(replace(BAD, checks=(SLOWER,) * 50)).splitlines()
    assert len(lines) <= 25
    assert lines[1].startswith("  fail: 0 of 50 checks passed")
    assert lines[-1].endswith("lines more")


def test_numbers_that_may_be_in_another_unit_are_warned_of(native_fmu: Path) -> None:
    with pytest.warns(UserWarning, match="drive_frequency = 20000 is in rad/s") as caught:
        opened = sr.open_fmu(native_fmu, device={"drive_frequency": 20000.0})
    with opened as fmu, pytest.warns(UserWarning, match="phase = 30 is in rad, which is 1718.87"):
        fmu.steady(phase=30)
    assert caught[0].filename == __file__, "where the package was called"
