"""Blocking force of an FMU by shooting: the load under which the steady displacement vanishes."""

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite

from slider_resonator.device.common_period import MAX_DENOMINATOR
from slider_resonator.fmu.instance import Instance
from slider_resonator.output.progress import Progress, no_progress
from slider_resonator.steady.periodic import (
    FmuPeriodMap,
    Obstacle,
    read_facts,
    repeating_periods,
    sticks_throughout,
)
from slider_resonator.steady.search_result import SearchResult, asked, cost, with_undamped_hint
from slider_resonator.steady.shooting import NoFixedPoint, blocked_point


@dataclass(frozen=True, repr=False)
class Blocking(SearchResult):
    """The result of a search for the blocking force.

    `blocking_force` (N) is None where there is none. `status` is blocked, unstable or neutral;
    without a force it is stuck, slow_beat (frequency_ratio next to an integer), no_common_period,
    no_fixed_point, not_unique or not_converged.
    """

    blocking_force: float | None = None

    @property
    def answer(self) -> tuple[str, float | None, str]:
        """The blocking force."""
        return "blocking force", self.blocking_force, "N"


def find_blocking(
    instance: Instance,
    values: Mapping[str, float],
    *,
    max_denominator: int = MAX_DENOMINATOR,
    progress: Progress = no_progress,
) -> Blocking:
    """Find the load that stops an FMU with the given parameters and inputs.

    A `load` among the values is where the search begins. `progress` gets the
    drive periods run, of some that a search takes. Raises FmuError and Refusal as `Instance.start`
    does.
    """
    facts = read_facts(instance, values)
    predicted = facts.blocking_force
    said = {"predicted": predicted, **asked(facts, searched="load")}
    count = repeating_periods(facts, max_denominator)
    if isinstance(count, Obstacle):
        return Blocking(count.status, count.reason, **said)
    period_map = FmuPeriodMap(instance, values, facts, count, progress)
    load = values.get("load", predicted if isfinite(predicted) else 0.0)
    warm = period_map.warm_up(0.0, load)
    if sticks_throughout(period_map.stick_fraction):
        return Blocking(
            "stuck",
            f"the slider sticks throughout at load = {load:.6g} N: every load that friction holds "
            "stops it, so that no single one is the blocking force",
            **said,
            **cost(period_map, None),
        )
    found = blocked_point(period_map, warm, load, max(facts.friction_limit, 1e-12))
    if isinstance(found, NoFixedPoint):
        reason = with_undamped_hint(found.reason, facts)
        return Blocking(found.status, reason, **said, **cost(period_map, found))
    return Blocking(
        "blocked" if found.stability == "stable" else found.stability,
        f"at this load the mean velocity is zero; the largest multiplier is "
        f"{abs(found.multipliers[0]):.9g}",
        **said,
        **cost(period_map, found),
        blocking_force=found.load,
    )
