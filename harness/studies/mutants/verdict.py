"""The verdict on a variant of an FMU, and on all variants of a run."""

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Generic, TypeVar

from studies.mutants.changes import Change
from studies.mutants.mutant import Mutant

REJECTED = "rejected"
SURVIVED = "survived"
EQUIVALENT = "equivalent"

STATUSES: Mapping[str, str] = {
    REJECTED: "by a scene: a check fails, or it cannot be run",
    SURVIVED: "passes every scene, though results are worse",
    EQUIVALENT: "no result is further off by more than a hundredth of what its check allows",
}
"""Status of a variant to its meaning."""

Variant = TypeVar("Variant", Mutant, Change)


@dataclass(frozen=True)
class Verdict(Generic[Variant]):
    """The status of a variant; of a rejected one the scene, the quantity and the reason.

    A rejected one without a quantity could not be run.
    """

    variant: Variant
    status: str
    scene: str = ""
    quantity: str = ""
    reason: str = ""

    @property
    def rejected(self) -> bool:
        """Whether a scene rejects it."""
        return self.status == REJECTED


@dataclass(frozen=True)
class MutationRun(Generic[Variant]):
    """The verdicts on faulty variants of an FMU, a sample of `made` ones, and on `harmless` ones.

    `wall_time` is in s.
    """

    fmu: str
    made: int
    verdicts: tuple[Verdict[Variant], ...]
    wall_time: float
    harmless: tuple[Verdict[Variant], ...] = ()

    @property
    def survivors(self) -> list[Verdict[Variant]]:
        """The verdicts on faulty variants that pass every scene, though results change."""
        return self.having(SURVIVED)

    @property
    def false_alarms(self) -> list[Verdict[Variant]]:
        """The verdicts on harmless variants that a scene rejects."""
        return [verdict for verdict in self.harmless if verdict.rejected]

    @property
    def counts(self) -> dict[str, int]:
        """Status to count of faulty variants."""
        return {status: len(self.having(status)) for status in STATUSES}

    @property
    def rate(self) -> float | None:
        """Rejected variants as a share of those that make a result worse; None without any."""
        rejected, survived = self.counts[REJECTED], self.counts[SURVIVED]
        return rejected / (rejected + survived) if rejected + survived else None

    def having(self, status: str) -> list[Verdict[Variant]]:
        """Return the verdicts on faulty variants with this status."""
        return [verdict for verdict in self.verdicts if verdict.status == status]

    def tally(self, key: str) -> dict[str, dict[str, int]]:
        """Return the counts for each `kind` or `file`, in their order."""
        found: dict[str, dict[str, int]] = {}
        for verdict in self.verdicts:
            counts = found.setdefault(getattr(verdict.variant, key), dict.fromkeys(STATUSES, 0))
            counts[verdict.status] += 1
        return found

    def rejections(self) -> list[tuple[str, int]]:
        """Return scenes and quantities that rejected variants with counts, largest first."""
        found = Counter(map(_rejected_by, self.having(REJECTED)))
        return sorted(found.items(), key=lambda item: (-item[1], item[0]))


def _rejected_by(verdict: Verdict[Variant]) -> str:
    if not verdict.scene:
        return "cannot be opened or freed"
    return f"{verdict.scene.partition(' at ')[0]}: {verdict.quantity or 'cannot be run'}"
