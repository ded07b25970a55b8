"""Blocking force of an FMU by shooting: the load under which the steady displacement vanishes."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite

from harness.common_period import MAX_DENOMINATOR
from harness.drive import Instance
from harness.periodic import (
    FmuPeriodMap,
    Obstacle,
    hidden_state,
    read_facts,
    repeating_periods,
)
from harness.shooting import FixedPoint, NoFixedPoint, blocking_point
from harness.steady import with_undamped_hint


@dataclass(frozen=True)
class Blocking:
    """The outcome of a search for the blocking force.

    `blocking_force` (N) is None where there is none; `predicted` is the FMU's own output
    `blocking_force`. `status` is blocked, unstable or neutral; without a force it is stuck,
    slow_beat (frequency_ratio next to an integer), no_common_period, hidden_state,
    no_fixed_point, not_unique or not_converged.
    """

    status: str
    reason: str
    predicted: float
    blocking_force: float | None = None
    common_period: int | None = None
    periods: int = 0
    iterations: int = 0
    residual: float | None = None
    multipliers: tuple[complex, ...] = ()
    stable: bool | None = None


def find_blocking(
    instance: Instance,
    values: Mapping[str, float],
    *,
    max_denominator: int = MAX_DENOMINATOR,
) -> Blocking:
    """Find the load that stops an FMU with the given parameters and inputs.

    A `load` among the values is where the search begins. Raises FmuError and Refusal as
    `Instance.start` does.
    """
    facts = read_facts(instance, values)
    predicted = facts.blocking_force
    count = hidden_state(facts) or repeating_periods(facts, max_denominator)
    if isinstance(count, Obstacle):
        return Blocking(count.status, count.reason, predicted)
    period_map = FmuPeriodMap(instance, values, facts, count)
    load = values.get("load", predicted if isfinite(predicted) else 0.0)
    state, scale, mean = period_map.warm_up(0.0, load)
    if period_map.stick_fraction == 1.0:
        return Blocking(
            "stuck",
            f"the slider sticks throughout at load = {load:.6g} N: every load that friction holds "
            "stops it, so that no single one is the blocking force",
            predicted,
            common_period=count,
            periods=period_map.periods,
        )
    state[0] -= mean
    found = blocking_point(
        period_map,
        state,
        load,
        scale,
        load_scale=max(facts.friction_limit, 1e-12),
        displacement_scale=float(scale[0]) * period_map.period,
    )
    if isinstance(found, NoFixedPoint):
        return Blocking(
            found.status,
            with_undamped_hint(found.reason, facts),
            predicted,
            common_period=count,
            periods=period_map.periods,
            iterations=found.iterations,
            residual=found.residual,
        )
    return Blocking(
        _status(found),
        f"at this load the mean velocity is zero; the largest multiplier is "
        f"{abs(found.multipliers[0]):.9g}",
        predicted,
        blocking_force=found.load,
        common_period=count,
        periods=period_map.periods,
        iterations=found.iterations,
        residual=found.residual,
        multipliers=tuple(found.multipliers.tolist()),
        stable=found.stability == "stable",
    )


def _status(found: FixedPoint) -> str:
    return "blocked" if found.stability == "stable" else found.stability
