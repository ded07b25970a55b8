"""Output and exit codes of `choose` and `run --auto`."""

import json
from pathlib import Path

from tests.harness.calling import call, refused
from tests.harness.public_json import assert_public_keys

SCENE = """
name = "mine"
title = "Mine"
[run]
drive_periods = 2000
steps_per_period = 0.2
[need]
"""
LOOSE = "mean_velocity = { rel = 0.05 }"
IMPOSSIBLE = "position = { rel = 1e-16 }"


def written(folder: Path, need: str) -> Path:
    path = folder / "mine.toml"
    path.write_text(f"{SCENE}{need}\n")
    return path


def test_a_choice_has_reasons_against_the_others(native_fmu: Path, tmp_path: Path) -> None:
    scene = written(tmp_path, LOOSE)
    result = call("choose", scene, "--fmu", native_fmu, "--json")
    assert result.exit_code == 0
    assert_public_keys("choose", result.stdout)
    answer = json.loads(result.stdout)
    assert (answer["fidelity"], answer["meets"]) == (0, True), "averages and leaps are cheap"
    assert 0.0 < answer["error"]["mean_velocity"] < answer["allowed"]["mean_velocity"]
    others = [(other["fidelity"], other["averaging_order"]) for other in answer["ruled_out"]]
    other_order = 3 - answer["averaging_order"]
    assert sorted(others, key=str) == [(0, other_order), (1, None), (2, None)], answer["ruled_out"]
    assert all(other["why"] for other in answer["ruled_out"])
    printed = call("choose", scene, "--fmu", native_fmu).stdout
    assert "chosen   fidelity 0, order " in printed
    assert "fidelity 2, Coulomb friction" in printed


def test_needs_and_time_need_no_scene_file(native_fmu: Path) -> None:
    device = ("--device", "ultrasonic_slider", "--set", "phase=30 deg")
    needs = ("--need", "mean_velocity=1 %", "--need", "position=2 um")
    asked = ("choose", "--fmu", native_fmu, *device, *needs, "--time", "20 ms", "--step", "50 us")
    assert "step     5e-05 s, 1 drive period\n" in call(*asked).stdout
    result = call(*asked, "--json")
    answer = json.loads(result.stdout)
    assert result.exit_code == 0
    assert answer["allowed"]["position"] == 2e-6
    assert answer["allowed"]["mean_velocity"] < 0.01
    assert all(answer["error"][name] <= answer["allowed"][name] for name in answer["allowed"])


def test_needs_must_be_there_and_suit_the_inputs(native_fmu: Path) -> None:
    said = refused("choose", "lift_off", "--fmu", native_fmu)
    assert "has no [need]; must" in said
    assert "as the scene feed_forward has; `slider-resonator choose --need` says it, too" in said
    said = refused("choose", "changing_inputs", "--fmu", native_fmu, "--need=steady_velocity=1 %")
    assert "need.steady_velocity needs constant inputs and parameters" in said


def test_a_run_uses_the_choice_and_reports_it(native_fmu: Path, tmp_path: Path) -> None:
    scene = written(tmp_path, LOOSE)
    result = call("run", native_fmu, scene, "--auto", "--json")
    assert result.exit_code == 0
    assert_public_keys("run", result.stdout)
    summary = json.loads(result.stdout)
    assert summary["auto"]["fidelity"] == 0
    assert summary["communication_steps"] == 1
    counts_none = summary["auto"]["averaging_order"] == 1
    assert (summary["reversals"] == 0) is counts_none, "leaps count them; both are cheap"
    plain = json.loads(call("run", native_fmu, scene, "--json").stdout)
    assert plain["auto"] is None
    assert plain["communication_steps"] == 400
    allowed = summary["auto"]["allowed"]["mean_velocity"]
    assert abs(summary["mean_velocity"] - plain["mean_velocity"]) < allowed


def test_nothing_is_run_where_nothing_suffices(native_fmu: Path, tmp_path: Path) -> None:
    scene, out = written(tmp_path, IMPOSSIBLE), tmp_path / "run.csv"
    for command in (
        ("choose", scene, "--fmu", native_fmu),
        ("run", native_fmu, scene, "--auto", "--out", out),
    ):
        result = call(*command)
        assert result.exit_code == 1
        assert "nearest  fidelity 2" in result.stdout
        assert "none suffices: position is off by" in result.stdout
    assert not out.exists()


def test_a_setting_that_the_fmu_refuses(native_fmu: Path, tmp_path: Path) -> None:
    scene, setting = written(tmp_path, LOOSE), ("--set", "damping_ratio=1e308")
    reported = "damping_ratio = 1e+308 refused: together with the other values"
    assert reported in refused("choose", scene, "--fmu", native_fmu, *setting)
    assert reported in refused("run", native_fmu, scene, "--auto", *setting)
