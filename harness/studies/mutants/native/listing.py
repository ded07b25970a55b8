"""Changes of the native FMU and their verdicts as text and as plain data for JSON."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from rich.console import Console
from rich.text import Text

from slider_resonator.output.fitting_table import STYLES
from slider_resonator.output.fitting_text import fitting, terminal_width
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Row, Style, Table, numbers, texts
from slider_resonator.output.terminal import escaped, rendered
from studies.mutants.native.change_verdict import ChangeVerdict, NativeRun
from studies.mutants.native.changes import Change


def print_changes(console: Console, changes: Sequence[Change]) -> None:
    """Print the name, file, meaning and texts of each change."""
    for change in changes:
        kind = "harmless" if change.harmless else "fault"
        console.print(Text(f"{change.name} [{kind}]", "bold"))
        console.print(Text(escaped(f"{change.file}: {change.meaning}\n{_diff(change)}")))
    console.print(f"{number_of(len(changes), 'change')}")


def print_native_run(console: Console, run: NativeRun) -> None:
    """Print counts by file, then survivors and false alarms with their reasons, and the rate."""
    console.print(rendered(_by_file(run)))
    for verdict in run.survivors:
        word, style = ("EXPLAINED ", Style.NOTE) if verdict.explained else ("SURVIVED ", Style.FAIL)
        _print_verdict(console, word, style, verdict, verdict.change.survives)
    for verdict in run.false_alarms:
        where = f"{verdict.scene}: {verdict.quantity}: {verdict.reason}"
        _print_verdict(console, "FALSE ALARM ", Style.FAIL, verdict, where)
    console.print(fitting(summary(run), terminal_width()), markup=False, soft_wrap=True)


def summary(run: NativeRun) -> str:
    """Return the result in a sentence."""
    rejected = sum(verdict.rejected for verdict in run.faults)
    explained = sum(verdict.explained for verdict in run.faults)
    variants = len(run.verdicts) - len(run.faults)
    rate = "none can be seen" if run.rate is None else f"{run.rate:.2%}"
    return (
        f"{run.fmu}: rejected {rejected} of the {len(run.faults) - explained} faults that a scene "
        f"can see: {rate}; {explained} others have a reason; rejected {len(run.false_alarms)} of "
        f"{variants} harmless variants ({run.wall_time:.0f} s)"
    )


def native_run_as_plain(run: NativeRun) -> dict[str, Any]:
    """Return a run without a verdict, which depends on the required rate."""
    return {
        "fmu": run.fmu,
        "rate": run.rate,
        "false_alarms": len(run.false_alarms),
        "wall_time": run.wall_time,
        "changes": [
            change_as_plain(verdict.change)
            | {name: getattr(verdict, name) for name in ("rejected", "scene", "quantity", "reason")}
            for verdict in run.verdicts
        ],
    }


def change_as_plain(change: Change) -> dict[str, Any]:
    """Return a change, with its texts."""
    names = ("name", "file", "old", "new", "meaning", "harmless", "survives")
    return {name: getattr(change, name) for name in names}


def _print_verdict(
    console: Console, word: str, style: Style, verdict: ChangeVerdict, reason: str
) -> None:
    change = verdict.change
    heading = Text.assemble((word, STYLES[style]), f"{change.file}: {change.name}")
    lines = [f"     {change.meaning}", *([f"     {reason}"] if reason else []), _diff(change)]
    console.print(heading, Text(escaped("\n".join(lines))), sep="\n")


def _diff(change: Change) -> str:
    old = [f"-{line}" for line in change.old.splitlines()]
    return "\n".join([*old, *(f"+{line}" for line in change.new.splitlines())])


def _by_file(run: NativeRun) -> Table:
    rows: dict[str, list[int]] = {}
    for verdict in run.verdicts:
        counts = rows.setdefault(verdict.change.file, [0, 0, 0, 0])
        if verdict.change.harmless:
            counts[3] += verdict.rejected
        else:
            counts[0 if verdict.rejected else 1 + verdict.explained] += 1
    table: list[Row] = [[file, *map(str, counts)] for file, counts in rows.items()]
    head = ("rejected", "survived", "explained", "false alarms")
    return Table([*texts("file"), *numbers(*head)], table)
