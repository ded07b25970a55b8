from __future__ import annotations

import json
from pathlib import Path

from tests.harness.calling import call


def test_a_case_is_repeated_with_its_values(native_fmu: Path, tmp_path: Path) -> None:
    out = tmp_path / "campaign.json"
    arguments = ["campaign", native_fmu, "--seed", "1", "--case", "10", "--out", out]
    result = call(*arguments)
    assert result.exit_code == 0, result.output
    assert "seed 1, 1 cases: 1 passed" in result.output
    assert "slider_mass = " in result.output
    again = json.loads(call(*arguments, "--json").stdout)
    assert again["fmus"][0]["worst"] == json.loads(out.read_text())["fmus"][0]["worst"]


def test_what_cannot_run_exits_with_2(tmp_path: Path) -> None:
    result = call("campaign", "missing.fmu", "--out", tmp_path / "campaign.json")
    assert result.exit_code == 2
    assert "missing.fmu: no such file" in result.output
