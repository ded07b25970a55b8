"""A mutation run as one HTML file that needs nothing beside it."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from pathlib import Path

from harness.atomic import replacing
from harness.mutants.listing import summary
from harness.mutants.verdict import (
    EQUIVALENT,
    NOT_REACHED,
    STATUSES,
    SURVIVED,
    MutationRun,
    Verdict,
)

_STYLE = """
body { font: 15px/1.45 system-ui, sans-serif; margin: 2rem auto; max-width: 72rem; padding: 0 1rem;
  color: #222 }
table { border-collapse: collapse; font-size: 13px; font-variant-numeric: tabular-nums;
  margin: 1rem 0 }
th, td { text-align: left; padding: .2rem .6rem; border-bottom: 1px solid #ddd }
td.n { text-align: right } summary { cursor: pointer; margin: .4rem 0 }
pre { background: #f6f6f6; padding: .6rem; overflow-x: auto; font-size: 12px }
.added { color: #1a7f37 } .gone { color: #b3261e } .why { color: #666 }
"""


def write_page(path: Path, run: MutationRun) -> None:
    """Write tables, and every mutant that was not rejected with its diff and the reason.

    Raises HarnessError when the file cannot be written.
    """
    parts = [
        '<!DOCTYPE html><html lang="en"><head><meta charset="utf-8">',
        '<meta name="viewport" content="width=device-width">',
        f"<title>Mutants</title><style>{_STYLE}</style></head><body><h1>Mutants</h1>",
        f"<p>{escape(summary(run))}</p>",
        _legend(run),
        _tally("kind", run),
        _tally("file", run),
        _rejections(run),
        "<h2>Survivors</h2>",
        *(_mutant(verdict, opened=True) for verdict in run.having(SURVIVED)),
        *_group("Equivalent within the allowed deviation", run.having(EQUIVALENT)),
        *_group("Not reached", run.having(NOT_REACHED)),
        "</body></html>",
    ]
    with replacing(path) as temporary:
        temporary.write_text("\n".join(parts) + "\n", encoding="utf-8")


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


def _group(heading: str, verdicts: Sequence[Verdict]) -> list[str]:
    return [f"<h2>{heading}</h2>", *(_mutant(verdict) for verdict in verdicts)]


def _mutant(verdict: Verdict, *, opened: bool = False) -> str:
    lines = "\n".join(map(_line, verdict.mutant.diff.splitlines()[2:]))
    return (
        f"<details{' open' * opened}><summary>{escape(verdict.mutant.name)}</summary>"
        f'<p class="why">{escape(verdict.reason)}</p><pre>{lines}</pre></details>'
    )


def _line(text: str) -> str:
    colour = {"+": "added", "-": "gone"}.get(text[:1])
    return f'<span class="{colour}">{escape(text)}</span>' if colour else escape(text)
