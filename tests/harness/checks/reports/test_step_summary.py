from __future__ import annotations

from dataclasses import replace
from pathlib import Path

from slider_resonator.checks.reports.step_summary import MAX_ROWS, append_summary
from tests.harness.verdicts import BAD, BROKEN, GOOD, SLOWER


def test_tables_are_appended(tmp_path: Path) -> None:
    path = tmp_path / "summary.md"
    path.write_text("# Before\n")
    append_summary(path, [GOOD, BAD, BROKEN])
    text = path.read_text()
    assert text.startswith("# Before\n")
    assert "| good.fmu | pass | 1 | 0 | 0 | 0 | 1.5 |" in text
    assert "| bad.fmu | **fail** | 1 | 2 | 0 | 0 | 2.5 |" in text
    assert "| broken.fmu | **could not be run** | 1 | 1 | 1 | 0 | 3.0 |" in text
    assert "from 0.0125 s on" in text


def test_no_message_leaves_its_cell(tmp_path: Path) -> None:
    path = tmp_path / "summary.md"
    append_summary(path, [BROKEN])
    (row,) = [line for line in path.read_text().splitlines() if "crashed" in line]
    assert row.replace("\\|", "").count("|") == 5
    assert "<b>" not in row


def test_a_hopeless_fmu_does_not_flood_the_page(tmp_path: Path) -> None:
    path = tmp_path / "summary.md"
    append_summary(path, [replace(BAD, checks=(SLOWER,) * 500)])
    assert path.read_text().count("steady_velocity") == MAX_ROWS
    assert "and 450 more" in path.read_text()
