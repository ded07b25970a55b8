from __future__ import annotations

import json
from pathlib import Path

import pytest

from slider_resonator.commands import extremes
from slider_resonator.stress.case import Hold, Limit, MatrixCell, Model
from tests.harness.calling import call
from tests.harness.public_json import assert_public_keys

HOLDS = (Hold(1e-4, 20),)
GOOD = MatrixCell("steps", "few", Model(2, 0), {}, HOLDS)
REFUSED = MatrixCell("mu", "0", Model(2, 1), {"friction_coefficient": 0.0}, HOLDS)
FLIES = Limit("position", 1.0, 1e-9, "it flies")
WRONG = MatrixCell("steps", "wrong", Model(1, 0), {}, HOLDS, limits=(FLIES,))


def extremes_of(
    monkeypatch: pytest.MonkeyPatch, cells: list[MatrixCell], *arguments: object
) -> tuple[int, str]:
    monkeypatch.setattr(extremes, "all_cells", lambda *, long: cells)
    result = call("extremes", *arguments)
    return result.exit_code, result.output


def test_results_are_written(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    out = tmp_path / "new"
    code, text = extremes_of(monkeypatch, [GOOD, REFUSED], native_fmu, "--out", out)
    assert code == 0, text
    assert "2 cells: 1 passed, 1 refused by name, 0 failed, none skipped" in text
    assert "worst cost of a step" in text
    document = (out / "extremes.json").read_text(encoding="utf-8")
    assert_public_keys("extremes", document)
    written = json.loads(document)
    verdicts = [one["verdict"] for one in written["fmus"][0]["verdicts"]]
    assert verdicts == ["passed", "refused by name"]
    assert "friction_coefficient = 0.0 refused" in (out / "extremes.md").read_text(encoding="utf-8")
    assert (out / "extremes_SliderResonator.png").read_bytes().startswith(b"\x89PNG")
    assert "friction_coefficient = 0.0 refused" in (out / "index.html").read_text(encoding="utf-8")


def test_one_cell_is_run_by_its_name(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    cells, options = [GOOD, WRONG], (native_fmu, "--out", tmp_path / "out", "--cell")
    code, text = extremes_of(monkeypatch, cells, *options, GOOD.name)
    assert code == 0, text
    assert "1 cell: 1 passed" in text
    code, text = extremes_of(monkeypatch, cells, *options, GOOD.name.replace(",", ""))
    assert code == 2
    words = " ".join(text.split())
    assert "refused: must be AXIS: VALUE: MODEL of a cell" in words
    assert f"did you mean '{GOOD.name}'?" in words


def test_a_failed_cell_exits_with_1(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, text = extremes_of(monkeypatch, [WRONG], native_fmu, "--out", tmp_path, "--json")
    assert code == 1
    assert "it flies" in json.loads(text)["fmus"][0]["verdicts"][0]["reason"]


def test_what_cannot_run_exits_with_2_before_anything_runs(
    native_fmu: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    run: list[Path] = []
    monkeypatch.setattr(extremes, "run_matrix", lambda fmu, *_: run.append(fmu))
    out = tmp_path / "out"
    code, text = extremes_of(monkeypatch, [GOOD], native_fmu, "missing.fmu", "--out", out)
    assert code == 2
    assert "missing.fmu: no such file" in text
    assert run == []
    assert not out.exists()
