"""The paper: its units, its tables, and what is confirmed."""

import json
from dataclasses import replace
from math import asin, cos, pi
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from slider_resonator.device.device import Device
from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.fmu.instance import Instance
from slider_resonator.references.averaged import device_average
from slider_resonator.references.averaged.uniform_average import LugreCase
from slider_resonator.references.equivalent_force import equivalent_force
from studies.paper import mapping
from studies.paper.average_error import errors, slope
from studies.paper.claim import Claim, statements
from studies.paper.figure_8 import PHASES
from studies.paper.listing import write_claims, write_index, write_tables
from studies.paper.mapping import coulomb_case, stiffness_of
from studies.paper.measure import blocking_force, record, steady_velocity
from studies.paper.reproduce import FIGURES, NAMES, TABLES, reproduce
from studies.paper.slow_theory import length_scale, strength_of, uniform_velocity
from studies.paper.stiffness_validity import CASE
from studies.paper.table import PaperTable
from tests.harness.golden import assert_as_before
from tests.harness.known_provenance import PROVENANCE

CLAIM = Claim("speed", "(5)", "It moves", {"v_m_per_s": 0.5}, "agrees", "it | does", True)


def test_claims_and_tables_are_written(tmp_path: Path) -> None:
    wrong = replace(CLAIM, name="other", verdict="disagrees", confirmed=False)
    write_claims(tmp_path, [("All", [CLAIM, wrong])], PROVENANCE)
    columns = {"kappa": "kappa", "error": "theory / FMU - 1", "other": "of FMUs"}
    bounds = {"error": 0.1, "other": 1.0}
    table = PaperTable("forces", "Forces", "In N.", columns, bounds, (), lambda *_: {})
    first, second = ({"kappa": k, "error": -0.05, "other": 0.02} for k in (1.0, 10.0))
    right, off = {"rows": [first, second]}, {"rows": [first, {**second, "error": -0.11}]}
    assert (table.confirmed(right), table.confirmed(off)) == (True, False), "of either sign"
    write_tables(tmp_path, [(table, right), (table, off)], PROVENANCE)
    for name in ("claims.md", "TABLES.md"):
        assert_as_before(f"paper_{name}", (tmp_path / name).read_text(encoding="utf-8"))


def test_the_index_has_all_figures_tables_and_claims_escaped(tmp_path: Path) -> None:
    wrong = replace(CLAIM, statement="It <b>flies</b>", verdict="disagrees", confirmed=False)
    table = PaperTable(
        "speeds", "Speeds", "By <load>.", {"v": "speed"}, {"v": 0.1}, (), lambda *_: {}
    )
    known = replace(PROVENANCE, fmus=(replace(PROVENANCE.fmus[0], fmu="<a>.fmu"),))
    shown = [(table, {"rows": [{"v": 0.2}]})]
    write_index(tmp_path, FIGURES.values(), shown, [("All", [CLAIM, wrong])], known)
    html = (tmp_path / "index.html").read_text(encoding="utf-8")
    assert "img-src data: 'self' file:" in html
    assert_as_before("paper_index.html", html.partition("</style>")[2])


def _device(values: mapping.Values) -> Device:
    return Device.from_mapping({k: v for k, v in values.items() if k != "phase"})


@pytest.mark.parametrize("frequency", [10.0, 1000.0])
def test_coulomb_case_is_in_the_paper_s_units(frequency: float) -> None:
    device = _device(mapping.coulomb_case(1.5, frequency))
    assert length_scale(device) == 1.0, "x0 = mu N0 / (m w0^2) = 1 m"
    assert strength_of(device) == pytest.approx(1.5, rel=1e-12), "q = F_T / Omega"
    assert equivalent_force(device).angle == 0.0, "the drive acts on the slider itself"


def test_lugre_case_keeps_mu_and_the_drive() -> None:
    case = LugreCase(strength=2.0, friction_coefficient=0.3, damping=0.7)
    device = _device(mapping.lugre_case(case, 50.0, 100.0))
    assert (device.friction_law, device.bristle_stiffness, device.bristle_damping) == (1, 100, 0.7)
    assert device.normal_preload / device.total_mass == 1.0, "x0 = N0 / (m w0^2) = 1 m"
    assert equivalent_force(device).velocity_amplitude == pytest.approx(2.0, rel=1e-12)
    assert device.friction_coefficient == 0.3


def test_a_first_swing_of_the_fmu_is_that_of_the_dimensionless_equation(instance: Instance) -> None:
    """From rest (2) sets off with F_T sin(Omega tau) - 1: X' is in closed form while X' > 0."""
    frequency, strength = 10.0, 3.0
    values = mapping.coulomb_case(strength, frequency, amplitude_ratio=0.0)
    run = record(instance, values, pi / frequency, 64)
    start = asin(1.0 / (strength * frequency)) / frequency
    expected = strength * (cos(frequency * start) + 1.0) - (pi / frequency - start)
    assert run["velocity"][-1] == pytest.approx(expected, rel=1e-12)


def test_no_steady_motion_is_an_error_with_its_reason(instance: Instance) -> None:
    with pytest.raises(FmuError, match="friction"):
        steady_velocity(instance, {**coulomb_case(1.0, 200.0), "load": 2.0})
    with pytest.raises(FmuError, match="no p/q"):
        blocking_force(instance, {**coulomb_case(1.0, 200.0), "frequency_ratio": 1.001})


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
            average = device_average.steady_velocity(Device(), phase, 0.0, float(ratio))
            assert velocity * length_scale(Device()) == pytest.approx(
                average, abs=0.01 * force.velocity_amplitude
            ), f"Coulomb average at ratio {ratio}, phase {phase}"

    assert np.argmax(results("figure_3")["phase"]["v"]) == 6, "quadrature is best"
    assert set(NAMES) == {*FIGURES, *TABLES, "claims"}
