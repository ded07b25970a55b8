"""Verdicts as a Markdown table on the page of a GitHub Actions run."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from slider_resonator.checks.validate import Validation
from slider_resonator.checks.verdict import TITLE, place, sentence, title
from slider_resonator.errors import HarnessError

VARIABLE = "GITHUB_STEP_SUMMARY"
"""Environment variable with the file that the page is made of."""
MOST_ROWS = 50
"""Failures shown for each FMU: GitHub takes 1 MiB of summary."""


def append_summary(
    path: Path, validations: Sequence[Validation], error: str = "", *, title: str = TITLE
) -> None:
    """Append a table of FMUs and one of what failed; HarnessError when that is impossible."""
    text = _markdown(validations, error, title)
    try:
        with path.open("a", encoding="utf-8") as file:
            file.write(text)
    except OSError as failed:
        raise HarnessError(f"{VARIABLE} {path}: cannot be written: {failed.strerror}") from failed


def _markdown(validations: Sequence[Validation], error: str, heading: str) -> str:
    lines = [f"## {heading}", ""]
    if error:
        lines += [f"Could not run: {_cell(error)}", ""]
    if validations:
        lines += ["| FMU | verdict | checks passed | failed | could not be run | seconds |"]
        lines += ["|---|---|--:|--:|--:|--:|"]
    for validation in validations:
        failed = sum(not check.passed for check in validation.checks)
        verdict = ("pass", "**fail**", "**could not be run**")[validation.exit_code]
        passed, run_failures = len(validation.checks) - failed, len(validation.run_failures)
        cells = (_cell(validation.fmu), verdict, passed, failed, run_failures)
        lines.append(f"| {' | '.join(map(str, cells))} | {validation.wall_time:.1f} |")
    rows = [row for validation in validations for row in _failures(validation)]
    if rows:
        lines += ["", "| FMU | scene | quantity | verdict |", "|---|---|---|---|", *rows]
    return "\n".join(lines) + "\n\n"


def _failures(validation: Validation) -> list[str]:
    found = [
        (run_failure.scene, place(run_failure.at) or "-", run_failure.reason)
        for run_failure in validation.run_failures
    ]
    found += [(c.scene, title(c), sentence(c)) for c in validation.checks if not c.passed]
    name = _cell(Path(validation.fmu).name)
    rows = [f"| {name} | {' | '.join(map(_cell, row))} |" for row in found[:MOST_ROWS]]
    if len(found) > MOST_ROWS:
        rows.append(f"| {name} | | | and {len(found) - MOST_ROWS} more |")
    return rows


def _cell(text: str) -> str:
    """Return a text that stays in its cell and is shown as it is."""
    escaped = text.replace("&", "&amp;").replace("<", "&lt;").replace("\\", "\\\\")
    return " ".join(escaped.replace("|", "\\|").replace("*", "\\*").split())
