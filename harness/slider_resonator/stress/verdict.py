"""The verdict on a cell and the bounds behind it."""

from __future__ import annotations

from dataclasses import dataclass

PASSED = "passed"
REFUSED = "refused by name"
FAILED = "failed"

REFERENCE = "reference"
"""Name of the check against a reference that shares no code with the FMU."""
NO_REFERENCE = "no reference"
"""Name of the check that reports why that reference gave up."""


@dataclass(frozen=True)
class BoundCheck:
    """One bound: the largest deviation found, in units of the allowed one.

    `is_deviation` is false for counts and yes-or-no answers, which have no distance to a bound.
    """

    name: str
    found: float
    words: str = ""
    is_deviation: bool = True

    @property
    def passed(self) -> bool:
        """Whether the bound holds; it does not for NaN."""
        return self.found <= 1.0


@dataclass(frozen=True)
class CellVerdict:
    """The verdict on one cell, the bounds behind it, and the reason where it did not pass."""

    axis: str
    value: str
    model: str
    verdict: str
    reason: str
    checks: tuple[BoundCheck, ...] = ()
    worst_step: float = 0.0
    period_cost: float = 0.0

    @property
    def cost_ratio(self) -> float:
        """Worst cost of a step, per period it spans (at least 1), relative to a period."""
        return self.worst_step / self.period_cost if self.period_cost > 0.0 else 0.0

    def has(self, check: str) -> bool:
        """Whether a check of this name was made."""
        return any(one.name == check for one in self.checks)

    @property
    def name(self) -> str:
        """Axis, value and model."""
        return f"{self.axis}: {self.value}: {self.model}"
