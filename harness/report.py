"""Verdicts for people: a table on a terminal or in a log."""

from __future__ import annotations

from rich import box
from rich.console import Console
from rich.table import Table
from rich.text import Text

from harness.compare import Check, Value
from harness.quantities import QUANTITIES
from harness.validate import Validation, worst_of_sweeps


def print_validation(console: Console, validation: Validation, *, details: bool = False) -> None:
    """Print the table of verdicts, the reasons of failures, and one line that sums up.

    Of a sweep the worst point is shown; with `details` every point, and why each thing is expected.
    """
    rows = (
        [(check, 1) for check in validation.checks]
        if details
        else worst_of_sweeps(validation.checks)
    )
    console.print(_table(rows, details))
    for check, _ in rows:
        if not check.passed:
            text = f"{check.scene}: {check.quantity}{_at(check, ' at ')}: {check.why}"
            console.print(
                Text.assemble(("FAIL ", "bold red"), text, f"\n     {check.note}".rstrip())
            )
    failed = sum(not check.passed for check in validation.checks)
    verdict = f"[bold red]{failed} failed[/], " if failed else ""
    console.print(
        f"{validation.fmu}: {verdict}{len(validation.checks) - failed} of "
        f"{len(validation.checks)} checks passed in {validation.wall_time:.1f} s"
    )


def _table(rows: list[tuple[Check, int]], details: bool) -> Table:
    table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    table.add_column("scene", overflow="fold")
    table.add_column("quantity", overflow="fold")
    if any(check.at for check, _ in rows):
        table.add_column("at", overflow="fold")
    for heading in ("FMU", "reference"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("is", overflow="fold")
    for heading in ("deviation", "allowed"):
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("verdict", no_wrap=True)
    scene = ""
    for check, points in rows:
        if scene and check.scene != scene:
            table.add_section()
        cells = [check.scene if check.scene != scene else "", _quantity(check)]
        if any(other.at for other, _ in rows):
            cells.append(_at(check, "") + (f", worst of {points}" if points > 1 else ""))
        cells += [_value(check.fmu), _value(check.reference), check.against.replace("_", " ")]
        cells += [_size(check.deviation), _size(check.allowed)]
        verdict = Text("pass", "green") if check.passed else Text("FAIL", "bold red")
        table.add_row(*(Text(cell) for cell in cells), verdict)
        if details:
            table.add_row("", Text(check.why, "dim"))
        scene = check.scene
    return table


def _quantity(check: Check) -> str:
    """Return name and unit; the deviation of a signal is a share of its peak."""
    if QUANTITIES[check.quantity].kind == "signal":
        return f"{check.quantity} [{check.unit}], peak"
    return f"{check.quantity} [{check.unit}]" if check.unit not in ("", "1") else check.quantity


def _at(check: Check, before: str) -> str:
    return before * bool(check.at) + ", ".join(f"{n} = {v:g}" for n, v in check.at.items())


def _value(value: Value) -> str:
    if value is None:
        return "none"
    return value if isinstance(value, str) else f"{value:.9g}"


def _size(size: float | None) -> str:
    return "-" if size is None else f"{size:.1e}" if size else "0"
