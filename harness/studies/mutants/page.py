"""A mutation run as one self-contained HTML file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from slider_resonator.fmu.provenance import Provenance
from slider_resonator.fmu.provenance_text import provenance_html
from slider_resonator.output.html_page import escaped, rendered, write_page
from slider_resonator.output.table import Table, numbers, texts
from studies.mutants.listing import rejections, summary, tally
from studies.mutants.verdict import (
    EQUIVALENT,
    NOT_REACHED,
    STATUSES,
    SURVIVED,
    MutantVerdict,
    MutationRun,
)


def write_mutants(path: Path, run: MutationRun, provenance: Provenance) -> None:
    """Write tables, and every mutant that was not rejected with its diff and the reason.

    Raises HarnessError when the file cannot be written.
    """
    parts = [
        f"<p>{escaped(summary(run))}</p>",
        rendered(_legend(run)),
        rendered(tally("kind", run)),
        rendered(tally("file", run)),
        rendered(rejections(run)),
        *_group("Survivors", run.having(SURVIVED), opened=True),
        *_group("Equivalent within the allowed deviation", run.having(EQUIVALENT)),
        *_group("Not reached", run.having(NOT_REACHED)),
        provenance_html(provenance),
    ]
    write_page(path, "Mutants", parts)


def _legend(run: MutationRun) -> Table:
    rows = [(status, str(run.counts[status]), meaning) for status, meaning in STATUSES.items()]
    return Table([*texts(""), *numbers("mutants"), *texts("")], rows)


def _group(heading: str, verdicts: Sequence[MutantVerdict], *, opened: bool = False) -> list[str]:
    shown = [_mutant(verdict, opened=opened) for verdict in verdicts] or ["<p>None.</p>"]
    return [f"<h2>{heading}</h2>", *shown]


def _mutant(verdict: MutantVerdict, *, opened: bool) -> str:
    lines = "\n".join(map(_line, verdict.mutant.diff.splitlines()[2:]))
    return (
        f"<details{' open' if opened else ''}><summary>{escaped(verdict.mutant.name)}</summary>"
        f'<p class="note">{escaped(verdict.reason)}</p><pre>{lines}</pre></details>'
    )


def _line(text: str) -> str:
    colour = {"+": "pass", "-": "fail"}.get(text[:1])
    return f'<span class="{colour}">{escaped(text)}</span>' if colour else escaped(text)
