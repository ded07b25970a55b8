"""The verdict on a mutant, and on all mutants of a run."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass

from studies.mutants.mutant import Mutant

REJECTED = "rejected"
SURVIVED = "survived"
EQUIVALENT = "equivalent"
NOT_REACHED = "not reached"

STATUSES: Mapping[str, str] = {
    REJECTED: "by a scene: a check fails, or it cannot be run",
    SURVIVED: "passes every scene, though results change",
    EQUIVALENT: "no result changes by more than the allowed deviation, in any scene or probe",
    NOT_REACHED: "no scene and no probe executes the changed statement",
}
"""Status of a mutant to its meaning."""


@dataclass(frozen=True)
class MutantVerdict:
    """The status of a mutant and its reason; for a rejected one the scene and quantity.

    A rejected one without a quantity could not be run.
    """

    mutant: Mutant
    status: str
    reason: str
    scene: str = ""
    quantity: str = ""


@dataclass(frozen=True)
class MutationRun:
    """The verdicts on the mutants of an FMU that were tried, out of `made` ones.

    `probes` is how many were used; `wall_time` is in s.
    """

    fmu: str
    made: int
    probes: int
    verdicts: tuple[MutantVerdict, ...]
    wall_time: float

    def having(self, status: str) -> list[MutantVerdict]:
        """Return the verdicts with this status."""
        return [verdict for verdict in self.verdicts if verdict.status == status]

    @property
    def counts(self) -> dict[str, int]:
        """Return status to count."""
        return {status: len(self.having(status)) for status in STATUSES}

    @property
    def rate(self) -> float | None:
        """Rejected mutants as a share of those that change a result; None without any."""
        rejected, survived = self.counts[REJECTED], self.counts[SURVIVED]
        return rejected / (rejected + survived) if rejected + survived else None

    def tally(self, key: str) -> dict[str, dict[str, int]]:
        """Return the counts for each `kind` or `file` of mutants, in their order."""
        found: dict[str, dict[str, int]] = {}
        for verdict in self.verdicts:
            counts = found.setdefault(getattr(verdict.mutant, key), dict.fromkeys(STATUSES, 0))
            counts[verdict.status] += 1
        return found

    def rejections(self) -> list[tuple[str, int]]:
        """Return scenes and quantities that rejected mutants with counts, largest first."""
        found = Counter(map(_rejected_by, self.having(REJECTED)))
        return sorted(found.items(), key=lambda item: (-item[1], item[0]))


def _rejected_by(verdict: MutantVerdict) -> str:
    if not verdict.scene:
        return "cannot be opened or freed"
    return f"{verdict.scene.partition(' at ')[0]}: {verdict.quantity or 'cannot be run'}"
