"""Find the steady velocity of an FMU by shooting, without a long run."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite

from slider_resonator.device.common_period import MAX_DENOMINATOR
from slider_resonator.fmu.instance import Instance
from slider_resonator.output.progress import Progress, no_progress
from slider_resonator.steady.periodic import (
    Facts,
    FmuPeriodMap,
    Obstacle,
    read_facts,
    repeating_periods,
    sticks_throughout,
)
from slider_resonator.steady.search_result import SearchResult, asked, cost, with_undamped_hint
from slider_resonator.steady.shooting import FixedPoint, NoFixedPoint, steady_point


@dataclass(frozen=True, repr=False)
class SteadyMotion(SearchResult):
    """The result of a search for steady motion.

    `steady_velocity` (m/s) is the mean over the common period, None where there is no steady
    motion; `state` is the one at theta = psi = 0. `status` is steady, stuck, unstable or neutral;
    without a velocity it is load_above_friction, slow_beat (frequency_ratio next to an integer),
    no_common_period, no_fixed_point, not_unique or not_converged.
    """

    steady_velocity: float | None = None
    state: Mapping[str, float] = field(default_factory=dict)

    @property
    def answer(self) -> tuple[str, float | None, str]:
        """The steady velocity."""
        return "steady velocity", self.steady_velocity, "m/s"


def find_steady(
    instance: Instance,
    values: Mapping[str, float],
    *,
    max_denominator: int = MAX_DENOMINATOR,
    progress: Progress = no_progress,
) -> SteadyMotion:
    """Find the steady motion of an FMU with the given parameters and inputs.

    An `initial_velocity` among the values is where the search begins, otherwise that is the FMU's
    own prediction. `progress` gets the drive periods run, of some that a search takes. Raises
    FmuError and Refusal as `Instance.start` does.
    """
    facts = read_facts(instance, values)
    said = {"predicted": facts.steady_velocity, **asked(facts)}
    runaway = _runaway(facts)
    # Damped bristles can give more friction than full sliding: only the search can decide.
    certain = runaway if facts["friction_law"] == 0 else None
    count = certain or repeating_periods(facts, max_denominator)
    if isinstance(count, Obstacle):
        return SteadyMotion(count.status, count.reason, **said)
    period_map = FmuPeriodMap(instance, values, facts, count, progress)
    guess = values.get("initial_velocity", facts.steady_velocity)
    found = steady_point(period_map, guess if isfinite(guess) else 0.0, facts["load"])
    if isinstance(found, NoFixedPoint):
        why = runaway or Obstacle(found.status, with_undamped_hint(found.reason, facts))
        return SteadyMotion(why.status, why.reason, **said, **cost(period_map, found))
    status, reason = _judge(found, period_map.stick_fraction)
    return SteadyMotion(
        status,
        with_undamped_hint(reason, facts) if status == "neutral" else reason,
        **said,
        **cost(period_map, found),
        steady_velocity=found.displacement / period_map.period,
        state=dict(zip(period_map.names, found.state.tolist(), strict=True)),
    )


def _runaway(facts: Facts) -> Obstacle | None:
    """Return the obstacle of a load that even full sliding friction cannot hold."""
    load, limit = facts["load"], facts.friction_limit
    if abs(load) < limit or (load == 0.0 and limit == 0.0):
        return None
    mass = facts["slider_mass"] + facts["resonator_mass"]
    rate = abs(load) - limit
    return Obstacle(
        "load_above_friction",
        f"no steady motion: load = {load:.6g} N is not below the {limit:.6g} N that friction "
        f"gives on average in full sliding; the slider gains {rate / mass:.3g} m/s every second",
    )


def _judge(found: FixedPoint, stick_fraction: float) -> tuple[str, str]:
    """Return status and reason of a motion that repeats."""
    if sticks_throughout(stick_fraction):
        return "stuck", "the slider sticks throughout: the drive does not overcome friction"
    largest = f"{abs(found.multipliers[0]):.9g}"
    return {
        "stable": ("steady", f"stable: the largest multiplier is {largest}"),
        "unstable": (
            "unstable",
            f"this motion repeats but departures from it grow by {largest} per common period: "
            "another one is reached in practice",
        ),
        "neutral": (
            "neutral",
            f"this motion repeats but departures from it neither grow nor decay ({largest})",
        ),
    }[found.stability]
