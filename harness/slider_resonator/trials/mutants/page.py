"""A mutation run as one HTML file that needs nothing beside it."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from slider_resonator.output.html_page import write_page
from slider_resonator.trials.mutants.listing import summary
from slider_resonator.trials.mutants.verdict import (
    EQUIVALENT,
    NOT_REACHED,
    STATUSES,
    SURVIVED,
    MutantVerdict,
    MutationRun,
)


def write_mutants(path: Path, run: MutationRun) -> None:
    """Write tables, and every mutant that was not rejected with its diff and the reason.

    Raises HarnessError when the file cannot be written.
    """
    parts = [
        f"<p>{escape(summary(run))}</p>",
        _legend(run),
        _tally("kind", run),
        _tally("file", run),
        _rejections(run),
        "<h2>Survivors</h2>",
        *(_mutant(verdict, opened=True) for verdict in run.having(SURVIVED)),
        *_group("Equivalent within the allowed deviation", run.having(EQUIVALENT)),
        *_group("Not reached", run.having(NOT_REACHED)),
    ]
    write_page(path, "Mutants", parts)


def _legend(run: MutationRun) -> str:
    rows = [[status, str(run.counts[status]), meaning] for status, meaning in STATUSES.items()]
    return _table(["", "mutants", ""], rows)


def _tally(key: str, run: MutationRun) -> str:
    rows = [
        [name, *(str(counts[status]) for status in STATUSES)] for name, counts in run.tally(key)
    ]
    return _table([key, *STATUSES], rows)


def _rejections(run: MutationRun) -> str:
    return _table(
        ["rejected first by", "mutants"], [[what, str(n)] for what, n in run.rejections()]
    )


def _table(heads: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    head = "".join(f"<th>{escape(name)}</th>" for name in heads)
    body = "\n".join(f"<tr>{''.join(map(_cell, row))}</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>\n{body}\n</tbody></table>"


def _cell(text: str) -> str:
    number = ' class="n"' if text.isdecimal() else ""
    return f"<td{number}>{escape(text)}</td>"


def _group(heading: str, verdicts: Sequence[MutantVerdict]) -> list[str]:
    return [f"<h2>{heading}</h2>", *(_mutant(verdict) for verdict in verdicts)]


def _mutant(verdict: MutantVerdict, *, opened: bool = False) -> str:
    lines = "\n".join(map(_line, verdict.mutant.diff.splitlines()[2:]))
    return (
        f"<details{' open' * opened}><summary>{escape(verdict.mutant.name)}</summary>"
        f'<p class="why">{escape(verdict.reason)}</p><pre>{lines}</pre></details>'
    )


def _line(text: str) -> str:
    colour = {"+": "pass", "-": "fail"}.get(text[:1])
    return f'<span class="{colour}">{escape(text)}</span>' if colour else escape(text)
