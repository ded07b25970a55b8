"""Verdicts for people: a table on a terminal or in a log."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

from rich import box
from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from slider_resonator.checks.compare import Check, Value
from slider_resonator.checks.validate import Validation, worst_of_sweeps
from slider_resonator.checks.verdict import place, sentence
from slider_resonator.output.readable import readable
from slider_resonator.scenes.vocabulary import QUANTITIES

FEW_SCENES = 3
"""Up to so many scenes are shown check by check; of more only what has failed."""
DIGITS = 8
"""Significant digits in the table; what is asserted is the deviation, which has its own column."""
SIGNAL = "*"


def print_validation(
    console: Console, validation: Validation, *, details: bool = False, only_failed: bool = False
) -> None:
    """Print the table of verdicts, the reasons of failures, and one line that sums up.

    Of a sweep the worst point is shown; with `details` every point, and why each thing is expected.
    Many scenes have a line each, with the check that is nearest to what is allowed. What has passed
    is left out with `only_failed`.
    """
    scenes: dict[str, list[Check]] = {}
    for check in validation.checks:
        scenes.setdefault(check.scene, []).append(check)
    if len(scenes) > FEW_SCENES and not (details or only_failed):
        console.print(_overview(scenes))
        only_failed = True
    checks = [check for check in validation.checks if not (only_failed and check.passed)]
    rows = [(check, 1) for check in checks] if details else worst_of_sweeps(checks)
    if rows:
        console.print(_table(rows, details))
    if any(_of_peak(check) for check, _ in rows):
        console.print(f"{SIGNAL} the peak of a signal; off by and allowed are shares of it")
    for check, _ in rows:
        if not check.passed:
            text = f"{check.scene}: {check.quantity}{place(check.at, ' at ')}: {check.why}"
            console.print(Text.assemble(("FAIL ", "bold red"), text, f"\n     {sentence(check)}"))
    failed = sum(not check.passed for check in validation.checks)
    verdict = f"[bold red]{failed} failed[/], " if failed else ""
    if validation.run_failures:
        verdict += f"[bold red]{len(validation.run_failures)} could not be run[/], "
    console.print(
        f"{escape(validation.fmu)}: {verdict}{len(validation.checks) - failed} of "
        f"{len(validation.checks)} checks passed in {validation.wall_time:.1f} s",
        soft_wrap=True,
    )


def _overview(scenes: Mapping[str, Sequence[Check]]) -> Table:
    """Return a line for each scene, with its check of the largest share of what is allowed."""
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("scene", overflow="fold")
    table.add_column("passed", justify="right", no_wrap=True)
    table.add_column("nearest to its bound", overflow="fold")
    for heading in ("off by", "allowed"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    for scene, checks in scenes.items():
        passed = sum(check.passed for check in checks)
        nearest = max(checks, key=lambda check: check.severity)
        cells = (scene, f"{passed} of {len(checks)}", nearest.quantity)
        sizes = (_size(nearest.deviation), _size(nearest.allowed))
        table.add_row(*(Text(cell) for cell in (*cells, *sizes)), _word(passed == len(checks)))
    return table


def _word(passed: bool) -> Text:
    return Text("pass", "green") if passed else Text("FAIL", "bold red")


def _table(rows: list[tuple[Check, int]], details: bool) -> Table:
    table = Table(box=box.SIMPLE_HEAD, padding=(0, 1, 0, 0), pad_edge=False)
    table.add_column("quantity", overflow="fold")
    swept = any(check.at for check, _ in rows)
    if swept:
        table.add_column("at" if details else "worst at", overflow="fold")
    for heading in ("FMU", "reference"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("against", overflow="fold")
    for heading in ("off by", "allowed"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("", no_wrap=True)
    scene = ""
    for check, points in rows:
        if check.scene != scene:
            table.add_section()
            table.add_row(Text(check.scene + f", {points} points" * (points > 1), "bold"))
            scene = check.scene
        cells = [f" {_quantity(check)}", *([place(check.at)] if swept else [])]
        cells += [_value(check.fmu), _value(check.reference), check.against.split("_")[0]]
        cells += [_size(check.deviation), _size(check.allowed)]
        table.add_row(*(Text(cell) for cell in cells), _word(check.passed))
        if details:
            table.add_row(Text(check.why, "dim"))
    return table


def _quantity(check: Check) -> str:
    """Return name and unit, with a mark for a signal."""
    unit = f", {check.unit}" * (check.unit not in ("", "1"))
    return f"{check.quantity}{SIGNAL * _of_peak(check)}{unit}"


def _of_peak(check: Check) -> bool:
    return QUANTITIES[check.quantity].relative_to_peak


def _value(value: Value) -> str:
    if value is None:
        return "none"
    return value if isinstance(value, str) else readable(value, DIGITS)


def _size(size: float | None) -> str:
    return "-" if size is None else f"{size:.1e}" if size else "0"
