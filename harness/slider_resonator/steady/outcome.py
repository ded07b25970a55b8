"""What a search by shooting ends with, whatever it looks for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from slider_resonator.steady.periodic import Facts, FmuPeriodMap
from slider_resonator.steady.shooting import FixedPoint, NoFixedPoint


@dataclass(frozen=True)
class Outcome:
    """How a search ended and what it cost.

    `status` is for machines, `reason` for people; `predicted` is what the FMU's own output says.
    The common period has `common_period` drive periods; `periods` counts all simulated ones.
    `multipliers` are the Floquet multipliers, largest first, `residual` the largest change of the
    state over the common period in units of its scale.
    """

    status: str
    reason: str
    predicted: float
    common_period: int | None = None
    periods: int = 0
    iterations: int = 0
    residual: float | None = None
    multipliers: tuple[complex, ...] = ()
    stable: bool | None = None


def cost(period_map: FmuPeriodMap, found: FixedPoint | NoFixedPoint | None) -> dict[str, Any]:
    """Return the fields of an outcome that follow from the search itself."""
    fields: dict[str, Any] = {
        "common_period": period_map.drive_periods,
        "periods": period_map.periods,
    }
    if found is not None:
        fields |= {"iterations": found.iterations, "residual": found.residual}
    if isinstance(found, FixedPoint):
        fields["multipliers"] = tuple(found.multipliers.tolist())
        fields["stable"] = found.stability == "stable"
    return fields


def why_not(found: NoFixedPoint, facts: Facts) -> tuple[str, str]:
    """Return status and reason of a search that found nothing."""
    return found.status, with_undamped_hint(found.reason, facts)


def with_undamped_hint(reason: str, facts: Facts) -> str:
    """Add, where it applies, that the resonator has no damping and so forgets nothing."""
    if facts["damping_ratio"] > 0.0:
        return reason
    return f"{reason} (damping_ratio = 0: the resonator never forgets its start)"
