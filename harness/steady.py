"""Steady velocity of an FMU by shooting: the FMU alone, no long run."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import isfinite

from harness.bracketing import bracketed_state
from harness.common_period import MAX_DENOMINATOR
from harness.drive import Instance
from harness.newton import Vector
from harness.periodic import (
    STATE,
    Facts,
    FmuPeriodMap,
    Obstacle,
    hidden_state,
    read_facts,
    repeating_periods,
)
from harness.shooting import FixedPoint, NoFixedPoint, fixed_point


@dataclass(frozen=True)
class SteadyMotion:
    """The outcome of a search for steady motion.

    `steady_velocity` (m/s) is the mean over the common period of `common_period` drive periods,
    None where there is no steady motion; `periods` counts all simulated drive periods; `state` is
    the one at theta = psi = 0 and `predicted` the FMU's own output `steady_velocity`. `status` is
    steady, stuck, unstable or neutral; without a velocity it is load_above_friction, slow_beat
    (frequency_ratio next to an integer), no_common_period, hidden_state, no_fixed_point,
    not_unique or not_converged.
    """

    status: str
    reason: str
    predicted: float
    steady_velocity: float | None = None
    common_period: int | None = None
    periods: int = 0
    iterations: int = 0
    residual: float | None = None
    multipliers: tuple[complex, ...] = ()
    stable: bool | None = None
    state: Mapping[str, float] = field(default_factory=dict)


def find_steady(
    instance: Instance,
    values: Mapping[str, float],
    *,
    max_denominator: int = MAX_DENOMINATOR,
) -> SteadyMotion:
    """Find the steady motion of an FMU with the given parameters and inputs.

    An `initial_velocity` among the values is where the search begins, otherwise that is the FMU's
    own prediction. Raises FmuError and Refusal as `Instance.start` does.
    """
    facts = read_facts(instance, values)
    predicted = facts.steady_velocity
    count = hidden_state(facts) or _runaway(facts) or repeating_periods(facts, max_denominator)
    if isinstance(count, Obstacle):
        return SteadyMotion(count.status, count.reason, predicted)
    period_map = FmuPeriodMap(instance, values, facts, count)
    found = _search(period_map, values)
    if isinstance(found, NoFixedPoint):
        return SteadyMotion(
            found.status,
            with_undamped_hint(found.reason, facts),
            predicted,
            common_period=count,
            periods=period_map.periods,
            iterations=found.iterations,
            residual=found.residual,
        )
    status, reason = _judge(found, period_map.stick_fraction)
    return SteadyMotion(
        status,
        with_undamped_hint(reason, facts) if status == "neutral" else reason,
        predicted,
        steady_velocity=found.displacement / period_map.period,
        common_period=count,
        periods=period_map.periods,
        iterations=found.iterations,
        residual=found.residual,
        multipliers=tuple(found.multipliers.tolist()),
        stable=found.stability == "stable",
        state=dict(zip(STATE, found.state.tolist(), strict=True)),
    )


def with_undamped_hint(reason: str, facts: Facts) -> str:
    """Add, where it applies, that the resonator has no damping and so forgets nothing."""
    if facts["damping_ratio"] > 0.0:
        return reason
    return f"{reason} (damping_ratio = 0: the resonator never forgets its start)"


def _search(period_map: FmuPeriodMap, values: Mapping[str, float]) -> FixedPoint | NoFixedPoint:
    """Shoot from the velocity that is wanted or predicted, or else from one between bounds."""
    load = period_map.facts["load"]

    def loaded(state: Vector) -> tuple[Vector, float]:
        return period_map(state, load)

    wanted = values.get("initial_velocity", period_map.facts.steady_velocity)
    velocity = wanted if isfinite(wanted) else 0.0
    state, scale, mean = period_map.warm_up(velocity, load)
    state[0] += velocity - mean  # from the mean velocity of the last period to the wanted one
    found = fixed_point(loaded, state, scale, load=load)
    if isinstance(found, FixedPoint):
        return found
    between = bracketed_state(loaded, state, scale)
    return found if between is None else fixed_point(loaded, between, scale, load=load)


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
    if found.displacement == 0.0 and stick_fraction == 1.0:
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
