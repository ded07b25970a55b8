"""Variants of an FMU and their verdicts as text and as plain data for JSON."""

from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.text import Text

from slider_resonator.output.readable import escaped, number_of
from slider_resonator.output.table import Row, Style, Table, numbers, texts
from slider_resonator.output.terminal import STYLES, fitting, show_table, terminal_width
from studies.mutants.changes import Change
from studies.mutants.mutant import KINDS, Mutant
from studies.mutants.verdict import STATUSES, MutationRun, Variant, Verdict

MAX_REJECTIONS = 12
"""Rows of the table of rejecting checks on a terminal; all are in the JSON document."""


def print_run(console: Console, run: MutationRun[Variant]) -> None:
    """Print counts, the most frequent rejections, survivors, false alarms and the rate."""
    if any(isinstance(verdict.variant, Mutant) for verdict in run.verdicts):
        show_table(console, tally("kind", run.tally("kind")))
    show_table(console, tally("file", run.tally("file")))
    if run.rejections():
        show_table(console, rejections(run, MAX_REJECTIONS))
    for verdict in run.survivors:
        _print_variant(console, "SURVIVED", verdict, verdict.reason)
    for verdict in run.false_alarms:
        why = f"{verdict.scene}: {verdict.quantity}: {verdict.reason}"
        _print_variant(console, "FALSE ALARM", verdict, why)
    for status, meaning in STATUSES.items():
        _print_fitting(console, f"{status:12} {run.counts[status]:5}  {meaning}")
    _print_fitting(console, escaped(summary(run)))


def summary(run: MutationRun[Variant]) -> str:
    """Return the result in a sentence."""
    counts = run.counts
    visible = counts["rejected"] + counts["survived"]
    rate = "none makes a result worse" if run.rate is None else f"{run.rate:.2%}"
    harmless = ""
    if run.harmless:
        harmless = f"; rejected {len(run.false_alarms)} of {len(run.harmless)} harmless variants"
    return (
        f"{run.fmu}: rejected {counts['rejected']} of the {visible} faults that make a result "
        f"worse: {rate} ({len(run.verdicts)} tried of {run.made}, {run.wall_time:.0f} s){harmless}"
    )


def print_variants(console: Console, variants: Sequence[Mutant] | Sequence[Change]) -> None:
    """Print the name, the kind and the diff of each variant."""
    for variant in variants:
        heading = Text(f"{variant.name} [{variant.kind}]", "bold")
        console.print(heading, Text(escaped(variant.diff)), sep="\n")
    console.print(number_of(len(variants), "variant"))


def mutants_as_plain(run: MutationRun[Mutant]) -> dict[str, Any]:
    """Return a run without a verdict, which depends on the required rate."""
    return {
        "fmu": run.fmu,
        "made": run.made,
        "tried": len(run.verdicts),
        "rate": run.rate,
        "counts": run.counts,
        "kinds": run.tally("kind"),
        "files": run.tally("file"),
        "rejections": dict(run.rejections()),
        "wall_time": run.wall_time,
        "mutants": [
            as_plain(verdict.variant) | {"status": verdict.status} | _rejection(verdict)
            for verdict in run.verdicts
        ],
    }


def changes_as_plain(run: MutationRun[Change]) -> dict[str, Any]:
    """Return a run of changes of the C sources without a verdict."""
    return {
        "fmu": run.fmu,
        "rate": run.rate,
        "false_alarms": len(run.false_alarms),
        "wall_time": run.wall_time,
        "changes": [
            as_plain(verdict.variant) | {"rejected": verdict.rejected} | _rejection(verdict)
            for verdict in (*run.verdicts, *run.harmless)
        ],
    }


def as_plain(variant: Mutant | Change) -> dict[str, Any]:
    """Return what identifies a variant, with its diff or its texts."""
    own: tuple[str, ...] = ("line", "column", "kind", "change", "diff")
    if isinstance(variant, Change):
        own = ("old", "new", "meaning", "harmless")
    return {name: getattr(variant, name) for name in ("name", "file", *own)}


def tally(key: str, counts: Mapping[str, Mapping[str, int]]) -> Table:
    """Return the counts by status for each kind or file."""
    meaning: Mapping[str, str] = KINDS if key == "kind" else {}
    rows: list[Row] = [
        [name, *(str(by_status[status]) for status in STATUSES), meaning.get(name, "")]
        for name, by_status in counts.items()
    ]
    return Table([*texts(key), *numbers(*STATUSES), *texts("what is changed")], rows)


def rejections(run: MutationRun[Variant], max_rows: int | None = None) -> Table:
    """Return what rejected variants; beyond `max_rows` the others are counted together."""
    found = run.rejections()
    shown, others = found[:max_rows], found[max_rows:] if max_rows else []
    rows = [(what, str(count)) for what, count in shown]
    if others:
        rows.append((f"{len(others)} others", str(sum(count for _, count in others))))
    return Table([*texts("rejected first by"), *numbers("variants")], rows)


def _rejection(verdict: Verdict[Variant]) -> dict[str, str]:
    return {name: getattr(verdict, name) for name in ("scene", "quantity", "reason")}


def _print_variant(console: Console, word: str, verdict: Verdict[Variant], why: str) -> None:
    heading = Text.assemble((f"{word} ", STYLES[Style.FAIL]), verdict.variant.name)
    reason = Text(escaped(f"     {why}"))
    console.print(heading, reason, Text(escaped(verdict.variant.diff)), sep="\n")


def _print_fitting(console: Console, text: str) -> None:
    console.print(fitting(text, terminal_width()), markup=False, soft_wrap=True)
