"""The verdicts on changes, as entries of the journal of a run."""

from __future__ import annotations

from collections.abc import Iterable

from slider_resonator.output.journal import Journal
from studies.mutants.native.change_verdict import ChangeVerdict
from studies.mutants.native.changes import Change


def entry_of(verdict: ChangeVerdict) -> list[object]:
    """Return the entry of a verdict in a journal, with the text that was changed."""
    change = verdict.change
    place = [change.name, change.file, change.old, change.new]
    return [*place, verdict.rejected, verdict.scene, verdict.quantity, verdict.reason]


def verdicts_on(journal: Journal, changes: Iterable[Change]) -> dict[str, ChangeVerdict]:
    """Return the verdicts that are kept on these changes, by name."""
    by_place = {(one.name, one.file, one.old, one.new): one for one in changes}
    kept = {}
    for name, file, old, new, *parts in journal.entries.values():
        change = by_place.get((name, file, old, new))
        if change is not None:
            kept[name] = ChangeVerdict(change, *parts)
    return kept
