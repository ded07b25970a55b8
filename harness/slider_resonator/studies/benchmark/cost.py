"""Methods that run the same motion, timed in turn and compared with a referee."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from math import pi
from statistics import median
from time import perf_counter

import numpy as np
from numpy.typing import NDArray

from slider_resonator.checks.measures.deviation import peak
from slider_resonator.device.device import Device
from slider_resonator.studies.trade.in_turn import Progress, Timed, in_turn

REFEREE = "Taylor with located events"
"""The method that tells the errors of all others, and its name where it is timed too."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Outcome:
    """Samples of one run at ends of drive periods, shape (n,), and counts over the run.

    `times` in s from 0. Counts are None where the method does not tell.
    """

    times: Array
    position: Array
    velocity: Array
    reversals: int | None
    steps: int
    evaluations: int | None


@dataclass(frozen=True)
class Method:
    """A way to run the device: `run` follows it over `periods` drive periods."""

    name: str
    periods: int
    run: Callable[[], Outcome]


@dataclass(frozen=True)
class Cost:
    """One method: medians over the repeats.

    `microseconds` per drive period, `fastest` and `slowest` the extremes over the repeats; errors
    are largest differences from the referee over the peak of the referee's signal, None for the
    referee itself; counts are for the whole run, None where the method does not tell.
    """

    method: str
    periods: int
    microseconds: float
    fastest: float
    slowest: float
    position_error: float | None
    velocity_error: float | None
    reversals: int | None
    steps: int
    evaluations: int | None


@dataclass(frozen=True)
class Ratio:
    """How many times as long `method` takes as `against`, and how many times as wrong it is."""

    method: str
    against: str
    time: float
    velocity_error: float | None


def measure(
    methods: Sequence[Method],
    referee: Outcome,
    device: Device,
    repeats: int,
    progress: Progress,
) -> tuple[Cost, ...]:
    """Time all methods `repeats` times, in turn, so that a busy moment hits all of them alike.

    A first run of each is not timed: some compile then, all warm the caches. `referee` covers at
    least one sample of each method after its start; a method called REFEREE is the same again.
    """
    outcomes = {}
    for index, method in enumerate(methods):
        progress(method.name, index / len(methods) / (repeats + 1))
        outcomes[method.name] = method.run()
    seconds = in_turn(
        [Timed(method.name, partial(_seconds, method), repeats) for method in methods],
        lambda name, share: progress(name, (1.0 + repeats * share) / (repeats + 1)),
    )
    progress("", 1.0)
    return tuple(
        _cost(method, taken, outcomes[method.name], referee, device)
        for method, taken in zip(methods, seconds, strict=True)
    )


def _seconds(method: Method) -> float:
    began = perf_counter()
    method.run()
    return perf_counter() - began


def ratio(cost: Cost, against: Cost) -> Ratio:
    """Compare two costs."""
    error, ours = cost.velocity_error, against.velocity_error
    return Ratio(
        cost.method,
        against.method,
        cost.microseconds / against.microseconds,
        error / ours if error is not None and ours else None,
    )


def cheapest_within(costs: Sequence[Cost], error: float) -> Cost | None:
    """The cheapest of `costs` whose errors are at most `error`; None if none is that exact."""
    good = [c for c in costs if max(c.velocity_error or 0.0, c.position_error or 0.0) <= error]
    return min(good, key=lambda c: c.microseconds, default=None)


def _cost(
    method: Method, seconds: Sequence[float], outcome: Outcome, referee: Outcome, device: Device
) -> Cost:
    is_referee = method.name == REFEREE
    per_period = [1e6 * s / method.periods for s in seconds]

    def error(name: str) -> float:
        """The largest difference at the common times, over the peak of the referee there."""
        period = 2.0 * pi / device.drive_frequency
        known = np.rint(referee.times / period).astype(int)
        sampled = np.rint(outcome.times / period).astype(int)
        _, at, of = np.intersect1d(sampled, known, return_indices=True)
        reference = getattr(referee, name)[of]
        return peak(getattr(outcome, name)[at] - reference) / peak(reference)

    return Cost(
        method=method.name,
        periods=method.periods,
        microseconds=median(per_period),
        fastest=min(per_period),
        slowest=max(per_period),
        position_error=None if is_referee else error("position"),
        velocity_error=None if is_referee else error("velocity"),
        reversals=outcome.reversals,
        steps=outcome.steps,
        evaluations=outcome.evaluations,
    )
