"""The verdicts of a mutation run, in a journal, so that the run can go on."""

from __future__ import annotations

import hashlib
import pickle
from collections.abc import Iterable, Sequence
from pathlib import Path

from slider_resonator.output.journal import Journal
from studies.mutants.mutant import Mutant
from studies.mutants.trial import ExpectedPoint
from studies.mutants.verdict import MutantVerdict


def open_journal(path: Path, fmu: Path, points: Sequence[ExpectedPoint]) -> Journal:
    """Open the journal of runs of these points on an FMU; HarnessError as `Journal` raises it."""
    content = hashlib.sha256(fmu.read_bytes())
    for point in points:
        content.update(repr((point.name, point.scene, point.share)).encode())
        content.update(pickle.dumps(point.expected))
    remedy = "move the file away or name another one"
    return Journal(path, "mutation run", content.hexdigest(), remedy)


def entry_of(verdict: MutantVerdict) -> list[str]:
    """Return the entry of a verdict in a journal."""
    return [verdict.mutant.name, verdict.status, verdict.reason, verdict.scene, verdict.quantity]


def verdicts_on(journal: Journal, mutants: Iterable[Mutant]) -> dict[str, MutantVerdict]:
    """Return the verdicts that are kept on these mutants, by name."""
    by_name = {mutant.name: mutant for mutant in mutants}
    kept = {}
    for name, *parts in journal.entries.values():
        if name in by_name:
            kept[name] = MutantVerdict(by_name[name], *parts)
    return kept
