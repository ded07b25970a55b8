"""The files that `run` reads and writes, and how long it runs."""

import csv
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

from slider_resonator.scenes.device_file import find_device
from slider_resonator.scenes.scene_files import find_scene
from tests.harness.calling import call, refused


def test_nothing_that_is_read_is_overwritten(python_fmu: Path, tmp_path: Path) -> None:
    fmu = Path(shutil.copy(python_fmu, tmp_path / "copy.csv"))
    scene = Path(shutil.copy(find_scene("lift_off").files[0], tmp_path / "scene.csv"))
    device = Path(shutil.copy(find_device("conveyor"), tmp_path / "mine.csv"))
    sources = ((fmu, "is the FMU"), (scene, "is the scene's file"), (device, "is the device"))
    for target, reported in sources:
        before = target.read_bytes()
        assert reported in refused("run", fmu, scene, "--device", device, "--out", target)
        assert target.read_bytes() == before


LINE = """
name = "line"
title = "Line"
[inputs]
load = { ramp = [[0.0, 0.0], [0.01, 0.2]] }
[run]
stop_time = 0.01
step_size = 0.005
"""


def test_ramps_are_held_or_passed_on(native_fmu: Path, python_fmu: Path, tmp_path: Path) -> None:
    held, passed = tmp_path / "held.toml", tmp_path / "passed.toml"
    held.write_text(LINE)
    passed.write_text(LINE + "interpolate = true\n")
    outs: list[str] = []
    for said, scene, *options in (
        ("between communication points, by their derivatives", held, "--interpolate"),
        ("between communication points, by their derivatives", passed),
        ("held over each step; `run --interpolate`", held),
        ("held over each step; `run --interpolate`", passed, "--no-interpolate"),
    ):
        out = tmp_path / f"{len(outs)}.csv"
        assert said in call("run", native_fmu, scene, *options, "--out", out).stdout
        outs.append(out.read_text())
    assert outs[0] == outs[1] != outs[2] == outs[3]
    said = call("run", python_fmu, held, "--interpolate").stdout
    assert "the FMU has canInterpolateInputs = false" in said


def test_without_a_scene_the_device_starts_from_rest(native_fmu: Path) -> None:
    arguments = ("--device", "ultrasonic_slider", "--json")
    named = json.loads(call("run", native_fmu, "table_1", *arguments).stdout)
    assert named["drive_periods"] == pytest.approx(100.0)
    for fmu in ((native_fmu,), ("--fmu", native_fmu)):
        summary = json.loads(call("run", *fmu, *arguments).stdout)
        assert (summary["scene"], summary["position"]) == ("table_1", named["position"])


SWITCHED_OFF = """
name = "off"
title = "Off"
[inputs]
amplitude_deviation = { steps = [[0.0, 0.0], [0.01, -1.0]] }
[run]
stop_time = 0.02
step_size = 0.0005
"""


def test_results_are_written_drawn_and_summed_up(native_fmu: Path, tmp_path: Path) -> None:
    scene = tmp_path / "off.toml"
    scene.write_text(SWITCHED_OFF)
    out, usual, chosen = (tmp_path / name for name in ("a.csv", "a.svg", "b.svg"))
    ran = call("run", native_fmu, scene, "--out", out, "--plot", usual)
    assert ran.exit_code == 0, ran.output
    rows = list(csv.DictReader(out.read_text().splitlines()))
    assert [float(row["amplitude_deviation"]) for row in rows] == [0.0] * 20 + [-1.0] * 21
    assert f"{float(rows[-1]['reversals']):.0f} reversals" in ran.stdout
    assert "11.1408 drive periods" in ran.stdout
    assert "us per drive period" in ran.stdout
    call("run", native_fmu, scene, "--plot", chosen, "--signals", "amplitude_deviation")
    for picture in (usual, chosen):
        assert "amplitude deviation" in picture.read_text(encoding="utf-8")


def test_fidelities_and_fmus_are_overlaid(native_fmu: Path, tmp_path: Path) -> None:
    picture = tmp_path / "a.svg"
    overlays = ["--overlay", "fidelity=1", "--overlay", native_fmu]
    window = ["--window", "0.1:0.105", "--signals", "velocity, friction_force"]
    done = call("run", native_fmu, "table_1", "--plot", picture, *overlays, *window)
    assert done.exit_code == 0, done.stderr
    text = picture.read_text(encoding="utf-8")
    assert "fidelity 1" in text
    assert text.count(native_fmu.name) >= 2
    assert "friction force" in text


def test_a_run_of_another_device_has_its_title(native_fmu: Path) -> None:
    result = call("run", native_fmu, "--device", "conveyor", "--set", "load=0.01")
    title = "A part on a vibratory conveyor, in scene table_1, load replaced"
    assert f"table_1: {title}" in result.stdout


def test_a_run_lasts_as_long_as_is_asked(native_fmu: Path) -> None:
    usual, longer = (
        json.loads(call("run", native_fmu, "table_1", *arguments, "--json").stdout)
        for arguments in ((), ("--time", "359.03916 ms"))
    )
    assert longer["simulated_time"] == pytest.approx(0.35903916)
    steps = longer["communication_steps"] / usual["communication_steps"]
    assert steps == pytest.approx(longer["simulated_time"] / usual["simulated_time"], rel=1e-3)
    coarse = call("run", native_fmu, "--time", "100 ms", "--step", "10 ms", "--json")
    assert json.loads(coarse.stdout)["communication_steps"] == 10


@pytest.mark.slow
def test_pictures_do_not_depend_on_settings_of_matplotlib(native_fmu: Path, tmp_path: Path) -> None:
    plain, own = tmp_path / "plain.png", tmp_path / "own.png"
    call("run", native_fmu, "--plot", plain)
    (tmp_path / "matplotlibrc").write_text("axes.facecolor: black\ntext.usetex: True\n")
    settings = {"MPLBACKEND": "module://nowhere", "MATPLOTLIBRC": str(tmp_path)}
    command = [sys.executable, "-m", "slider_resonator", "run", str(native_fmu), "--plot", str(own)]
    subprocess.run(command, check=True, capture_output=True, env={**os.environ, **settings})
    assert own.read_bytes() == plain.read_bytes()
