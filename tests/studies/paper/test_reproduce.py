from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.errors import HarnessError
from slider_resonator.references.averaged.device_average import steady_velocity
from slider_resonator.references.equivalent_force import equivalent_force
from studies.paper.average_error import errors, slope
from studies.paper.claim import statements
from studies.paper.figure_8 import PHASES
from studies.paper.mapping import stiffness_of
from studies.paper.reproduce import FIGURES, NAMES, TABLES, reproduce
from studies.paper.slow_theory import length_scale, uniform_velocity
from studies.paper.stiffness_validity import CASE


def _quiet(label: str, share: float) -> None:
    """Take no notice of progress."""


def test_an_unknown_name_is_refused(native_fmu: Path, tmp_path: Path) -> None:
    with pytest.raises(HarnessError, match="figure_6"):
        reproduce(native_fmu, tmp_path, ("figure_6",), _quiet)


@pytest.mark.slow
def test_a_part_is_written_beside_existing_files(native_fmu: Path, tmp_path: Path) -> None:
    outcome = reproduce(native_fmu, tmp_path, ("figure_3",), _quiet)
    assert outcome.run == ["figure_3"]
    assert {path.name for path in tmp_path.iterdir()} == {
        *("figure_3.png", "figure_3.svg", "FIGURES.md", "index.html", "results")
    }
    outcome = reproduce(native_fmu, tmp_path, ("lugre_blocking",), _quiet)
    (table,) = outcome.tables
    assert table.confirmed
    assert outcome.confirmed
    assert table.largest["uniform_deviation"] <= 2e-3
    assert "lugre_blocking" in (tmp_path / "TABLES.md").read_text(encoding="utf-8")
    assert "figure_3" in (tmp_path / "FIGURES.md").read_text(encoding="utf-8"), "still there"
    assert {path.stem for path in (tmp_path / "results").iterdir()} == {
        "figure_3",
        "lugre_blocking",
    }


@pytest.mark.slow
def test_the_whole_paper_is_confirmed(native_fmu: Path, tmp_path: Path) -> None:
    outcome = reproduce(native_fmu, tmp_path, (), _quiet)
    assert [claim.name for claim in outcome.claims if not claim.confirmed] == []
    assert [claim.name for claim in outcome.claims] == list(statements())
    for name in FIGURES:
        assert (tmp_path / f"{name}.png").stat().st_size > 10_000
        assert (tmp_path / f"{name}.svg").stat().st_size > 10_000
    assert [table.name for table in outcome.tables if table.confirmed] == list(TABLES)

    def results(name: str) -> Any:
        text = (tmp_path / "results" / f"{name}.json").read_text(encoding="utf-8")
        return json.loads(text)["data"]

    for name, (frequencies, error) in errors(results("average_error")).items():
        found = slope(frequencies, error)
        assert found == pytest.approx(-1.0, abs=0.06), f"{name}: averages err by 1 / Omega"

    points = results("stiffness_validity")["velocity"]
    for kappa, velocity in zip(points["x"], points["v"], strict=True):
        average = uniform_velocity(CASE, stiffness_of(kappa, CASE, 1000.0), 1000.0)
        assert velocity == pytest.approx(average, abs=2e-3), f"uniform average at kappa {kappa}"

    force = equivalent_force(Device())
    for ratio, values in results("figure_8")["phase"].items():
        for phase, velocity in zip(PHASES, values, strict=True):
            average = steady_velocity(Device(), phase, 0.0, float(ratio))
            assert velocity * length_scale(Device()) == pytest.approx(
                average, abs=0.01 * force.velocity_amplitude
            ), f"Coulomb average at ratio {ratio}, phase {phase}"

    assert np.argmax(results("figure_3")["phase"]["v"]) == 6, "quadrature is best"
    assert set(NAMES) == {*FIGURES, *TABLES, "claims"}
