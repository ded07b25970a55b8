"""The Python API: what the commands do, for scripts."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from fmpy import simulate_fmu

import slider_resonator as sr
from slider_resonator.fmu import finished

STEADY_VELOCITY = 0.0986951
"""Of table 1 at phase 0.4 rad and a load of 0.05 N, by Taylor integration, m/s."""


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
    assert sr.read_scene(built_in, load=0.02).values["load"] == 0.02
    with pytest.raises(sr.HarnessError, match=r"scene: run\.stop_tim"):
        sr.read_scene({"run": {"stop_tim": 1.0}})
    with pytest.raises(sr.HarnessError, match="did you mean 'phase'"):
        sr.read_scene("table_1", phse=1.0)
    with pytest.raises(sr.HarnessError, match="load = nan: must be a finite number"):
        sr.read_scene("table_1", load=float("nan"))
    for scenes in ("blocking_force_table_1", ["blocking_force_table_1"]):
        (validation,) = sr.validate(native_fmu, scenes=scenes)
        assert validation.passed
        assert {check.scene for check in validation.checks} == {"blocking_force_table_1"}
    assert sr.choose("feed_forward", native_fmu).meets
    table = tmp_path / "table.csv"
    result = sr.sweep(
        {"measures": ["steady_velocity"], "list": {"phase": [0.0, 0.4]}},
        table,
        native_fmu,
        workers=1,
    )
    assert (result.points, result.failed) == (2, 0)
    assert table.read_text().count("\n") == 3


def test_a_table_of_other_points_is_replaced_only_where_that_is_asked_for(
    native_fmu: Path, tmp_path: Path
) -> None:
    table = tmp_path / "table.csv"
    table.write_text("point,phase\n0,1.0\n")
    grid = {"measures": ["steady_velocity"], "list": {"phase": [0.4]}}
    with pytest.raises(sr.HarnessError, match="not a table of this grid's points"):
        sr.sweep(grid, table, native_fmu, workers=1)
    assert sr.sweep(grid, table, native_fmu, workers=1, overwrite=True).points == 1
    assert "0.4" in table.read_text()
    with pytest.raises(sr.HarnessError, match=r"the suffix is '\.xls'; must be one of \.parquet"):
        sr.sweep(grid, tmp_path / "table.xls", native_fmu, workers=1)


def test_what_a_script_gets_wrong_is_named(native_fmu: Path) -> None:
    with sr.open_fmu(native_fmu) as fmu:
        record = fmu.run({"run": {"stop_time": 0.01, "step_size": 0.01}})
        with pytest.raises(sr.HarnessError, match=r"phase = '0\.4 kg': not in rad; must be"):
            fmu.steady(phase="0.4 kg")
    for read in (record.__getitem__, record.final):
        with pytest.raises(sr.HarnessError, match="unknown output 'positon'; did you mean 'pos"):
            read("positon")


def test_a_refusal_of_the_fmu_is_an_error_with_its_text(native_fmu: Path) -> None:
    with sr.open_fmu(native_fmu) as fmu:
        with pytest.raises(sr.HarnessError, match=r"friction_coefficient = 0\.0 refused: with"):
            fmu.run("table_1", friction_law=1, friction_coefficient=0.0)
        assert fmu.run("table_1").final("position") > 0.0, "the FMU can still be used"


def test_finished_fmus_are_found_or_the_remedy_is_named(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(finished, "FOLDERS", (tmp_path,))
    with pytest.raises(sr.HarnessError, match="in a checkout `make build` builds it"):
        sr.fmu_path()
    for build, name in finished.FMUS.items():
        (tmp_path / name).touch()
        assert sr.fmu_path(build) == tmp_path / name
    with pytest.raises(sr.HarnessError, match="'fmi2': must be one of 'native', 'python', 'fmi3'"):
        sr.fmu_path("fmi2")  # type: ignore[arg-type]


def test_no_scenes_are_not_all_scenes() -> None:
    with pytest.raises(sr.HarnessError, match="must be at least one scene"):
        sr.validate("no.fmu", scenes=[])
