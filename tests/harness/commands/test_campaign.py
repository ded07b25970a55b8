from __future__ import annotations

import json
from pathlib import Path

from tests.harness.calling import call


def test_a_case_is_repeated_with_its_values(native_fmu: Path, tmp_path: Path) -> None:
    out = tmp_path / "campaign.json"
    arguments = ["campaign", native_fmu, "--seed", "1", "--case", "10", "--out", out]
    result = call(*arguments)
    assert result.exit_code == 0, result.output
    assert "seed 1, 1 case: 1 passed" in result.output
    assert "slider_mass = " in result.output
    again = json.loads(call(*arguments, "--json").stdout)
    written = json.loads(out.read_text())
    assert again["fmus"][0]["worst"] == written["fmus"][0]["worst"]
    assert written["provenance"]["fmus"][0]["fmu"].endswith(native_fmu.name)


def test_a_page_is_written(native_fmu: Path, tmp_path: Path) -> None:
    page = tmp_path / "campaign.html"
    result = call("campaign", native_fmu, "--cases", "2", "--html", page)
    assert result.exit_code == 0, result.output
    assert str(page) in "".join(result.output.split("\n"))
    assert '"label":"Coulomb, fidelity 2"' in page.read_text(encoding="utf-8")


def test_page_and_result_are_two_files(native_fmu: Path, tmp_path: Path) -> None:
    result = call("campaign", native_fmu, "--html", native_fmu)
    assert result.exit_code == 2
    assert "must end in .html" in result.output or "--html" in result.output


def test_what_cannot_run_exits_with_2(tmp_path: Path) -> None:
    result = call("campaign", "missing.fmu", "--out", tmp_path / "campaign.json")
    assert result.exit_code == 2
    assert "missing.fmu: no such file" in result.output
