"""The verdict on a change of the C sources, and on all changes of a run."""

from __future__ import annotations

from dataclasses import dataclass

from studies.mutants.native.changes import Change


@dataclass(frozen=True)
class ChangeVerdict:
    """Whether a change is rejected, by which scene and quantity, and why.

    A rejected one without a quantity could not be run.
    """

    change: Change
    rejected: bool
    scene: str = ""
    quantity: str = ""
    reason: str = ""

    @property
    def explained(self) -> bool:
        """Whether it is a fault that no scene can see, with the reason given beside it."""
        return bool(self.change.survives) and not self.rejected


@dataclass(frozen=True)
class NativeRun:
    """The verdicts on changes of an FMU; `wall_time` is in s."""

    fmu: str
    verdicts: tuple[ChangeVerdict, ...]
    wall_time: float

    @property
    def faults(self) -> tuple[ChangeVerdict, ...]:
        """The verdicts on faults."""
        return tuple(v for v in self.verdicts if not v.change.harmless)

    @property
    def survivors(self) -> tuple[ChangeVerdict, ...]:
        """The faults that pass every scene, those with a reason too."""
        return tuple(v for v in self.faults if not v.rejected)

    @property
    def false_alarms(self) -> tuple[ChangeVerdict, ...]:
        """The harmless variants that a scene rejects."""
        return tuple(v for v in self.verdicts if v.change.harmless and v.rejected)

    @property
    def rate(self) -> float | None:
        """Rejected faults as a share of those that a scene can see; None without any."""
        seen = [v for v in self.faults if not v.explained]
        return sum(v.rejected for v in seen) / len(seen) if seen else None
