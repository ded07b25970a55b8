from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.errors import HarnessError
from slider_resonator.references.averaged import uniform_average
from slider_resonator.references.averaged.averaged_coulomb import device_steady_velocity_at_ratio
from slider_resonator.references.closed_forms import equivalent_force
from slider_resonator.studies.paper.average_error import errors, slope
from slider_resonator.studies.paper.figure_8 import PHASES
from slider_resonator.studies.paper.reproduce import FIGURES, NAMES, TABLES, reproduce
from slider_resonator.studies.paper.stiffness_validity import CASE, stiffness_of


def _quiet(label: str, share: float) -> None:
    """Take no notice of progress."""


def test_only_what_is_missing_is_made(native_fmu: Path, tmp_path: Path) -> None:
    first = reproduce(native_fmu, tmp_path, ("figure_3",), _quiet)
    assert (first.run, first.kept) == (["figure_3"], [])
    drawn = (tmp_path / "figure_3.png").stat().st_mtime_ns
    again = reproduce(native_fmu, tmp_path, ("figure_3",), _quiet)
    assert (again.run, again.kept) == ([], ["figure_3"])
    assert (tmp_path / "figure_3.png").stat().st_mtime_ns == drawn

    (tmp_path / "figure_3.svg").unlink()
    results = (tmp_path / "results" / "figure_3.json").stat().st_mtime_ns
    redrawn = reproduce(native_fmu, tmp_path, ("figure_3",), _quiet)
    assert redrawn.run == ["figure_3"]
    assert (tmp_path / "figure_3.svg").is_file()
    assert (tmp_path / "results" / "figure_3.json").stat().st_mtime_ns == results, "not measured"


def test_results_of_another_fmu_are_replaced(native_fmu: Path, tmp_path: Path) -> None:
    reproduce(native_fmu, tmp_path, ("figure_3",), _quiet)
    path = tmp_path / "results" / "figure_3.json"
    content = json.loads(path.read_text(encoding="utf-8"))
    path.write_text(json.dumps({**content, "key": "of another"}), encoding="utf-8")
    assert reproduce(native_fmu, tmp_path, ("figure_3",), _quiet).run == ["figure_3"]


def test_an_unknown_name_is_refused(native_fmu: Path, tmp_path: Path) -> None:
    with pytest.raises(HarnessError, match="figure_6"):
        reproduce(native_fmu, tmp_path, ("figure_6",), _quiet)


def test_tables_are_kept_too_and_judged(native_fmu: Path, tmp_path: Path) -> None:
    first = reproduce(native_fmu, tmp_path, ("lugre_blocking",), _quiet)
    assert (first.run, first.kept) == (["lugre_blocking"], [])
    again = reproduce(native_fmu, tmp_path, ("lugre_blocking",), _quiet)
    assert (again.run, again.kept) == ([], ["lugre_blocking"])
    (table,) = again.tables
    assert table.confirmed
    assert table.largest["uniform_deviation"] <= 2e-3
    assert again.confirmed
    assert "lugre_blocking" in (tmp_path / "TABLES.md").read_text(encoding="utf-8")
    reproduce(native_fmu, tmp_path, ("figure_3",), _quiet)
    assert "lugre_blocking" in (tmp_path / "TABLES.md").read_text(encoding="utf-8"), "still holds"


@pytest.mark.slow
def test_the_whole_paper_is_confirmed(native_fmu: Path, tmp_path: Path) -> None:
    outcome = reproduce(native_fmu, tmp_path, (), _quiet)
    assert [claim["name"] for claim in outcome.claims if not claim["confirmed"]] == []
    assert len(outcome.claims) >= 25
    for name in FIGURES:
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
        assert (tmp_path / f"{name}.svg").stat().st_size > 10_000
    assert outcome.wall_time < 600.0, "the whole paper takes less than ten minutes"
    assert [table.name for table in outcome.tables if table.confirmed] == list(TABLES)

    data = json.loads((tmp_path / "results" / "average_error.json").read_text(encoding="utf-8"))
    for name, (frequencies, error) in errors(data["data"]).items():
        found = slope(frequencies, error)
        assert found == pytest.approx(-1.0, abs=0.06), f"{name}: averages err by 1 / Omega"

    data = json.loads((tmp_path / "results" / "stiffness_validity.json").read_text("utf-8"))["data"]
    for kappa, velocity in zip(data["velocity"]["x"], data["velocity"]["v"], strict=True):
        average = uniform_average.steady_velocity(CASE, stiffness_of(kappa), 1000.0)
        assert velocity == pytest.approx(average, abs=2e-3), f"uniform average at kappa {kappa}"

    data = json.loads((tmp_path / "results" / "figure_8.json").read_text("utf-8"))["data"]
    force = equivalent_force(Device())
    for ratio, values in data["phase"].items():
        for phase, velocity in zip(PHASES, values, strict=True):
            average = device_steady_velocity_at_ratio(Device(), phase, float(ratio))
            assert velocity * force.length_scale == pytest.approx(
                average, abs=0.01 * force.velocity_amplitude
            ), f"Coulomb average at ratio {ratio}, phase {phase}"

    data = json.loads((tmp_path / "results" / "figure_3.json").read_text(encoding="utf-8"))
    assert np.argmax(data["data"]["phase"]["v"]) == 6, "quadrature is best"
    assert set(NAMES) == {*FIGURES, *TABLES, "claims"}
