"""Verdicts as a Markdown table on the page of a GitHub Actions run."""

from collections.abc import Sequence
from pathlib import Path

from slider_resonator.checks.validate import Validation, provenance_of_all
from slider_resonator.checks.verdict import TITLE, place, sentence, title
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.provenance import provenance_markdown
from slider_resonator.output.markdown import escaped, rendered
from slider_resonator.output.table import Cell, Row, Style, Table, numbers, texts

VARIABLE = "GITHUB_STEP_SUMMARY"
"""Environment variable with the file that GitHub renders."""
MAX_ROWS = 50
"""Failures shown for each FMU: GitHub takes 1 MiB of summary."""
OUTCOMES = (
    Cell("pass", Style.PASS),
    Cell("fail", Style.FAIL),
    Cell("could not be run", Style.FAIL),
)
"""By exit code."""


def append_summary(
    path: Path, validations: Sequence[Validation], error: str = "", *, title: str = TITLE
) -> None:
    """Append a table of FMUs and one of what failed; HarnessError when that is impossible."""
    text = "\n\n".join([f"## {title}", *_parts(validations, error)]) + "\n\n"
    try:
        with path.open("a", encoding="utf-8") as file:
            file.write(text)
    except OSError as failed:
        raise HarnessError(f"{VARIABLE} {path}: cannot be written: {failed.strerror}") from failed


def _parts(validations: Sequence[Validation], error: str) -> list[str]:
    parts = [f"Could not run: {escaped(error)}"] if error else []
    if validations:
        columns = numbers(
            "checks passed", "failed", "could not be run", "not applicable", "seconds"
        )
        rows = [_fmu(validation) for validation in validations]
        parts.append(rendered(Table([*texts("FMU", "verdict"), *columns], rows)))
    parts += [
        escaped(f"{Path(validation.fmu).name}: {validation.without}")
        for validation in validations
        if validation.without
    ]
    skipped: list[Row] = [
        (Path(validation.fmu).name, *row)
        for validation in validations
        for row in validation.inapplicable[:MAX_ROWS]
    ]
    if skipped:
        columns = texts("FMU", "scene", "quantity", "not applicable because")
        parts.append(rendered(Table(columns, skipped)))
    failures = [row for validation in validations for row in _failures(validation)]
    if failures:
        parts.append(rendered(Table(texts("FMU", "scene", "quantity", "verdict"), failures)))
    parts.append(provenance_markdown(provenance_of_all(validations)))
    return parts


def _fmu(validation: Validation) -> Row:
    failed = len(validation.failed)
    counts = (
        *(len(validation.checks) - failed, failed),
        *(len(validation.run_failures), len(validation.not_applied)),
    )
    seconds = f"{validation.wall_time:.1f}"
    return (validation.fmu, OUTCOMES[validation.exit_code], *map(str, counts), seconds)


def _failures(validation: Validation) -> list[Row]:
    found = [
        (run_failure.scene, place(run_failure.at) or "-", run_failure.reason)
        for run_failure in validation.run_failures
    ]
    found += [(c.scene, title(c), sentence(c)) for c in validation.failed]
    name = Path(validation.fmu).name
    rows: list[Row] = [(name, *row) for row in found[:MAX_ROWS]]
    if len(found) > MAX_ROWS:
        rows.append((name, "", "", f"and {len(found) - MAX_ROWS} more"))
    return rows
