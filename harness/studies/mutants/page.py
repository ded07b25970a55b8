"""A mutation run as one self-contained HTML file."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from slider_resonator.fmu.provenance import Provenance
from slider_resonator.fmu.provenance_text import provenance_html
from slider_resonator.output.html_page import escaped, rendered, write_page
from slider_resonator.output.table import Table, numbers, texts
from studies.mutants.listing import rejections, summary, tally
from studies.mutants.mutant import Mutant
from studies.mutants.verdict import EQUIVALENT, STATUSES, MutationRun, Verdict


def write_mutants(path: Path, run: MutationRun[Mutant], provenance: Provenance) -> None:
    """Write tables, and every mutant that was not rejected with its diff.

    Raises HarnessError when the file cannot be written.
    """
    parts = [
        f"<p>{escaped(summary(run))}</p>",
        rendered(_legend(run)),
        rendered(tally("kind", run.tally("kind"))),
        rendered(tally("file", run.tally("file"))),
        rendered(rejections(run)),
        *_group("Survivors", run.survivors, opened=True),
        *_group("Equivalent", run.having(EQUIVALENT)),
        provenance_html(provenance),
    ]
    write_page(path, "Mutants", parts)


def _legend(run: MutationRun[Mutant]) -> Table:
    rows = [(status, str(run.counts[status]), meaning) for status, meaning in STATUSES.items()]
    return Table([*texts(""), *numbers("mutants"), *texts("")], rows)


def _group(heading: str, verdicts: Sequence[Verdict[Mutant]], *, opened: bool = False) -> list[str]:
    shown = [_mutant(verdict, opened=opened) for verdict in verdicts] or ["<p>None.</p>"]
    return [f"<h2>{heading}</h2>", *shown]


def _mutant(verdict: Verdict[Mutant], *, opened: bool) -> str:
    lines = "\n".join(map(_line, verdict.variant.diff.splitlines()[2:]))
    return (
        f"<details{' open' if opened else ''}><summary>{escaped(verdict.variant.name)}</summary>"
        f"<pre>{lines}</pre></details>"
    )


def _line(text: str) -> str:
    colour = {"+": "pass", "-": "fail"}.get(text[:1])
    return f'<span class="{colour}">{escaped(text)}</span>' if colour else escaped(text)
