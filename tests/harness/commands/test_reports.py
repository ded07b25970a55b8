from __future__ import annotations

import hashlib
import json
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

import slider_resonator
from slider_resonator.checks.validate import RunFailure
from slider_resonator.commands.reports import Reports, print_run_failures
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.provenance import identity_of
from tests.harness.verdicts import GOOD


def test_run_failures_are_reported_with_their_place(capsys: pytest.CaptureFixture[str]) -> None:
    run_failures = [
        RunFailure("swept", "crashed", {"phase": 0.4}),
        RunFailure("", "my.fmu: corrupt", {}),
    ]
    print_run_failures("my.fmu", run_failures)
    assert capsys.readouterr().err.splitlines() == [
        "error: my.fmu: scene swept at phase 0.4: crashed",
        "error: my.fmu: corrupt",
    ]


def test_output_of_an_fmu_commands_neither_terminal_nor_ci(
    capsys: pytest.CaptureFixture[str],
) -> None:
    print_run_failures("my.fmu", [RunFailure("", "crashed\x1b[2J\n::stop-commands::all", {})])
    assert capsys.readouterr().err == "error: crashed\ufffd[2J\n  : :stop-commands::all\n"


def test_an_error_before_any_fmu_is_in_every_report(tmp_path: Path) -> None:
    junit, html, written, summary = (
        tmp_path / name for name in ("report.xml", "report.html", "report.json", "summary.md")
    )
    Reports("A title", junit, html, written, summary).write([], "my.fmu: corrupt")
    (error,) = ET.parse(junit).getroot().iter("error")
    assert error.get("message") == "my.fmu: corrupt"
    for page in (html, summary):
        assert "Could not run: my.fmu: corrupt" in page.read_text(encoding="utf-8")
    expected = {"schema_version": 1, "passed": False, "error": "my.fmu: corrupt"}
    document = json.loads(written.read_text())
    assert document.pop("provenance")["fmus"] == []
    assert document == expected


def test_reports_are_written_even_where_the_summary_cannot_be(tmp_path: Path) -> None:
    paths = [tmp_path / name for name in ("report.xml", "report.html", "report.json")]
    junit, html, written = paths
    reports = Reports("A title", junit, html, written, tmp_path / "none" / "summary.md")
    with pytest.raises(HarnessError, match=r"GITHUB_STEP_SUMMARY .*cannot be written"):
        reports.write([], "my.fmu: corrupt")
    assert all(path.is_file() for path in paths)


def test_every_report_says_what_it_judged(tmp_path: Path) -> None:
    fmu = tmp_path / "a.fmu"
    fmu.write_bytes(b"no archive, but a file")
    digest = hashlib.sha256(fmu.read_bytes()).hexdigest()
    judged = replace(GOOD, fmu=str(fmu), identity=identity_of(fmu))
    fmu.write_bytes(b"another file since")
    files = [tmp_path / name for name in ("report.xml", "report.html", "report.json", "summary.md")]
    Reports("A title", *files).write([judged])
    for file in files:
        text = file.read_text(encoding="utf-8")
        assert text.count(digest) == 1, file.name
        for name in ("fmpy", "harness", "platform"):
            assert name in text, file.name
        assert slider_resonator.__version__ in text, file.name
