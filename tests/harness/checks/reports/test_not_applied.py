"""Every report says what an FMU lacks, and which checks say nothing about it."""

from __future__ import annotations

import io
import json
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

from rich.console import Console

from slider_resonator.checks.reports.html_report import write_html
from slider_resonator.checks.reports.json_report import validations_as_json
from slider_resonator.checks.reports.junit import write_junit
from slider_resonator.checks.reports.step_summary import append_summary
from slider_resonator.checks.reports.terminal import print_validation
from slider_resonator.checks.validate import NotApplied, Validation
from tests.harness.verdicts import GOOD, LACKING


def test_the_terminal_lists_them() -> None:
    console = Console(file=io.StringIO(), width=200)
    print_validation(console, LACKING)
    text = console.file.getvalue()  # type: ignore[attr-defined]
    assert "not applicable: order_2 at load 0.1: position: needs | <averaging_order>" in text
    assert "1 of 1 checks passed" in text
    assert "judged without averaging_order" in text
    assert "1 check does not apply" in text


def test_many_of_one_reason_have_one_line_unless_details_are_asked_for() -> None:
    many = tuple(NotApplied(f"ramp_{i}", "position", "needs ramps", {}) for i in range(5))
    validation = replace(LACKING, not_applied=many)
    for details in (False, True):
        console = Console(file=io.StringIO(), width=200)
        print_validation(console, validation, details=details)
        text = console.file.getvalue()  # type: ignore[attr-defined]
        assert text.count("not applicable: ") == (5 if details else 1)
        assert ("5 checks of 5 scenes: needs ramps (--details lists them)" in text) != details


def test_json_has_them() -> None:
    found = json.loads(validations_as_json([LACKING]))
    assert found["lacks"] == ["averaging_order"]
    (entry,) = found["not_applicable"]
    assert entry == {
        "scene": "order_2",
        "quantity": "position",
        "reason": "needs | <averaging_order>",
        "at": {"load": 0.1},
    }
    assert json.loads(validations_as_json([GOOD]))["not_applicable"] == []


def test_junit_counts_them_as_skipped(tmp_path: Path) -> None:
    path = tmp_path / "report.xml"
    write_junit(path, [LACKING, GOOD])
    root = ET.parse(path).getroot()
    assert (root.attrib["tests"], root.attrib["skipped"]) == ("3", "1")
    (skipped,) = root.iter("skipped")
    assert skipped.attrib["message"] == "not applicable: needs | <averaging_order>"
    (judged,) = (one for one in root.iter("property") if one.get("name") == "judged")
    assert "judged without averaging_order" in judged.attrib["value"]


def test_the_page_and_the_summary_have_them_escaped(tmp_path: Path) -> None:
    page, summary = tmp_path / "report.html", tmp_path / "summary.md"
    write_html(page, [LACKING])
    append_summary(summary, [LACKING])
    for path in (page, summary):
        text = path.read_text()
        assert "judged without averaging" in text.replace("\\_", "_")
        assert "order" in text
        assert "<averaging_order>" not in text
    assert "| old.fmu | pass | 1 | 0 | 0 | 1 | 1.0 |" in summary.read_text()


def test_an_fmu_to_which_nothing_applies_is_not_passed() -> None:
    nothing = Validation("old.fmu", (), 0.1, not_applied=(NotApplied("a", "position", "b", {}),))
    assert not nothing.passed
    assert nothing.exit_code == 2
    assert (LACKING.passed, LACKING.exit_code) == (True, 0)
