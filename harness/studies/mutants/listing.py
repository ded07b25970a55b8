"""A mutation run as text and as plain data for JSON."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from rich.console import Console
from rich.text import Text

from slider_resonator.output.fitting_table import STYLES
from slider_resonator.output.fitting_text import fitting, terminal_width
from slider_resonator.output.readable import number_of
from slider_resonator.output.table import Row, Style, Table, numbers, texts
from slider_resonator.output.terminal import escaped, rendered
from studies.mutants.mutant import KINDS, Mutant
from studies.mutants.verdict import STATUSES, SURVIVED, MutationRun

MAX_REJECTIONS = 12
"""Rows of the table of rejecting checks; all are in the JSON document."""


def print_run(console: Console, run: MutationRun) -> None:
    """Print counts by kind and file, the most frequent rejections, the survivors and the rate."""
    console.print(rendered(_kinds(run)))
    console.print(rendered(tally("file", run)))
    if run.rejections():
        console.print(rendered(rejections(run, MAX_REJECTIONS)))
    for verdict in run.having(SURVIVED):
        heading = Text.assemble(("SURVIVED ", STYLES[Style.FAIL]), verdict.mutant.name)
        reason = Text(escaped(f"     {verdict.reason}"))
        console.print(heading, reason, Text(escaped(verdict.mutant.diff)), sep="\n")
    for status, meaning in STATUSES.items():
        _print_fitting(console, f"{status:12} {run.counts[status]:5}  {meaning}")
    _print_fitting(console, escaped(summary(run)))


def _print_fitting(console: Console, text: str) -> None:
    console.print(fitting(text, terminal_width()), markup=False, soft_wrap=True)


def summary(run: MutationRun) -> str:
    """Return the result in a sentence."""
    counts = run.counts
    changing = counts["rejected"] + counts[SURVIVED]
    rate = "none changes a result" if run.rate is None else f"{run.rate:.2%}"
    return (
        f"{run.fmu}: rejected {counts['rejected']} of the {changing} mutants that change a result: "
        f"{rate} ({len(run.verdicts)} tried of {run.made}, {number_of(run.probes, 'probe')}, "
        f"{run.wall_time:.0f} s)"
    )


def print_mutants(console: Console, mutants: list[Mutant]) -> None:
    """Print each mutant with its diff."""
    for mutant in mutants:
        console.print(
            Text(f"{mutant.name} [{mutant.kind}]", "bold"), escaped(mutant.diff), sep="\n"
        )
    console.print(f"{number_of(len(mutants), 'mutant')}")


def run_as_plain(run: MutationRun) -> dict[str, Any]:
    """Return a run without a verdict, which depends on the required rate."""
    return {
        "fmu": run.fmu,
        "made": run.made,
        "tried": len(run.verdicts),
        "probes": run.probes,
        "rate": run.rate,
        "counts": run.counts,
        "kinds": run.tally("kind"),
        "files": run.tally("file"),
        "rejections": dict(run.rejections()),
        "wall_time": run.wall_time,
        "mutants": [
            mutant_as_plain(verdict.mutant)
            | {name: getattr(verdict, name) for name in ("status", "scene", "quantity", "reason")}
            for verdict in run.verdicts
        ],
    }


def mutant_as_plain(mutant: Mutant) -> dict[str, Any]:
    """Return the identity of a mutant and its diff."""
    names = ("name", "file", "line", "column", "kind", "change", "diff")
    return {name: getattr(mutant, name) for name in names}


def tally(key: str, run: MutationRun) -> Table:
    """Return the counts by status for each kind or file."""
    rows = [_counts(name, counts) for name, counts in run.tally(key).items()]
    return Table([*texts(key), *numbers(*STATUSES)], rows)


def _kinds(run: MutationRun) -> Table:
    rows = [[*_counts(name, counts), KINDS[name]] for name, counts in run.tally("kind").items()]
    return Table([*texts("kind"), *numbers(*STATUSES), *texts("what is changed")], rows)


def _counts(name: str, counts: Mapping[str, int]) -> Row:
    return [name, *(str(counts[status]) for status in STATUSES)]


def rejections(run: MutationRun, max_rows: int | None = None) -> Table:
    """Return what rejected mutants; beyond `max_rows` the others are counted together."""
    found = run.rejections()
    shown, others = found[:max_rows], found[max_rows:] if max_rows else []
    rows = [(what, str(count)) for what, count in shown]
    if others:
        rows.append((f"{len(others)} others", str(sum(count for _, count in others))))
    return Table([*texts("rejected first by"), *numbers("mutants")], rows)
