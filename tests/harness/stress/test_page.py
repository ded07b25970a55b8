from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from slider_resonator.stress.case import Model
from slider_resonator.stress.page import repeating, write_matrix_page
from slider_resonator.stress.run import Matrix
from slider_resonator.stress.verdict import (
    FAILED,
    PASSED,
    REFUSED,
    BoundCheck,
    CellVerdict,
)
from tests.harness.known_provenance import PROVENANCE
from tests.html_pages import Page, without_spans

RESOLVED, SLOW = Model(2, 0).name, Model(0, 1, 2).name
CHECKS = (BoundCheck("momentum", 1e-3), BoundCheck("reference", 0.5))
VERDICTS = (
    CellVerdict("q & r", "1e3", RESOLVED, PASSED, "", CHECKS, 1e-6, 1e-6),
    CellVerdict("q & r", "1e6", RESOLVED, FAILED, "it <flies>"),
    CellVerdict("q & r", "1e6", SLOW, REFUSED, "load refused"),
)
MATRIX = Matrix("my.fmu", VERDICTS, 3.0)


def text_of(tmp_path: Path, *matrices: Matrix) -> str:
    page = tmp_path / "index.html"
    write_matrix_page(page, matrices, PROVENANCE)
    found = Page.read(page)
    assert "provenance" in found.ids
    assert found.loaded == ["data:,"]
    return page.read_text(encoding="utf-8")


def test_each_cell_is_in_the_grid_with_its_checks(tmp_path: Path) -> None:
    text = text_of(tmp_path, MATRIX)
    assert "reference: 0.5 of what is allowed\nmomentum: 0.001 of what is allowed" in text
    assert '">F</td>' in text
    assert '">r</td>' in text
    assert text.count("<td></td>") == 1, "the cell that the axis does not have"
    assert "q &amp; r" in text


def test_an_interrupted_run_without_failures_is_incomplete_and_has_not_failed(
    tmp_path: Path,
) -> None:
    so_far = replace(MATRIX, verdicts=VERDICTS[::2], not_run=1)
    text = without_spans(text_of(tmp_path, so_far))
    assert "incomplete</td>" in text
    assert "FAIL" not in text
    assert "1 not run: incomplete" in text
    failed = without_spans(text_of(tmp_path, replace(MATRIX, not_run=1)))
    assert "FAIL</td>" in failed, "a failure stands, whatever the rest would have been"


def test_cells_that_did_not_pass_are_listed_with_their_command(tmp_path: Path) -> None:
    text = text_of(tmp_path, MATRIX)
    assert "it &lt;flies&gt;" in text
    assert "it <flies>" not in text
    assert without_spans(text).count("--cell ") == 2
    expected = (
        "slider-resonator extremes my.fmu --cell 'q & r: 1e6: Coulomb, fidelity 2' --out one_cell"
    )
    assert repeating(MATRIX, VERDICTS[1]) == expected


def test_failed_cells_are_open_and_those_refused_by_name_are_folded(tmp_path: Path) -> None:
    text = text_of(tmp_path, MATRIX)
    assert '<details id="failed-my.fmu" open><summary><h3>Failed</h3> 1 cell' in text
    assert '<details id="refused-by-name-my.fmu"><summary><h3>Refused by name</h3> 1 cell' in text


def test_a_matrix_of_which_nothing_ran_has_a_page(tmp_path: Path) -> None:
    assert "not run" in text_of(tmp_path, Matrix("my.fmu", (), 0.0, 5))
