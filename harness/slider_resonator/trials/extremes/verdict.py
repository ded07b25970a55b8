"""What is said of a cell."""

from __future__ import annotations

from dataclasses import dataclass

PASSED = "passed"
REFUSED = "refused by name"
FAILED = "failed"

REFEREE = "referee"
"""Name of the check against a reference that shares no code with the FMU."""
NO_REFEREE = "no referee"
"""Name of the check that tells why that reference gave up."""


@dataclass(frozen=True)
class Check:
    """One bound: the largest deviation that was found, in units of what is allowed.

    `is_deviation` is false for what is counted or told apart, where nearness means nothing.
    """

    name: str
    found: float
    words: str = ""
    is_deviation: bool = True

    @property
    def passed(self) -> bool:
        """Whether the bound holds; not a number never does."""
        return self.found <= 1.0


@dataclass(frozen=True)
class Verdict:
    """The verdict on one cell, the checks behind it, and its reason where it did not pass."""

    axis: str
    value: str
    model: str
    verdict: str
    reason: str
    checks: tuple[Check, ...] = ()
    worst_step: float = 0.0
    period_cost: float = 0.0

    @property
    def cost_ratio(self) -> float:
        """Worst cost of a step, per period in it but at least one, over that of a period."""
        return self.worst_step / self.period_cost if self.period_cost > 0.0 else 0.0

    def has(self, check: str) -> bool:
        """Whether a check of this name was made."""
        return any(one.name == check for one in self.checks)

    @property
    def name(self) -> str:
        """Axis, value and model."""
        return f"{self.axis}: {self.value}: {self.model}"
