"""Judge an FMU at scene points, as `validate` does, up to the first check that fails."""

import threading
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from slider_resonator.checks.compare import Comparison, compare
from slider_resonator.checks.fmu_side import measure_points
from slider_resonator.checks.measuring import Measurement, measure_all
from slider_resonator.checks.verdict import place, sentence
from slider_resonator.fmu.isolation.process import Outcome
from slider_resonator.scenes.scene import ScenePoint

NEGLIGIBLE = 0.01
"""By how much a result may be further off, as a share of what its check allows."""


@dataclass(frozen=True, eq=False)
class BenchPoint(ScenePoint):
    """A scene point with the expected value of each of its expectations.

    `original` are the measurements of the unchanged FMU, which took the CPU time `cost` (s).
    """

    expected: tuple[Any, ...] = ()
    original: tuple[Measurement, ...] = ()
    cost: float = 0.0


@dataclass(frozen=True)
class Rejection:
    """The rejection of an FMU: scene, quantity and reason in a sentence.

    Without a quantity it could not be run there; without a scene, nowhere.
    """

    scene: str
    quantity: str
    reason: str


@dataclass(frozen=True)
class Tried:
    """The rejection of an FMU, or without one the first result `worse` than the original's."""

    rejection: Rejection | None
    worse: str = ""


def trial(
    fmu: Path, points: Sequence[BenchPoint], time_limit: float, stopped: threading.Event
) -> Tried:
    """Judge the points one after the other, in a process that may take `time_limit` (s) for each.

    Where the FMU crashes, hangs or refuses, that is a rejection as well. Ends when `stopped` is
    set, with a result that says nothing.
    """
    worse = ""
    with closing(measure_points(fmu, points, measure_all, time_limit)) as outcomes:
        for point, outcome in outcomes:
            if stopped.is_set():
                break
            rejection = not_run(point, outcome)
            if rejection is None and point is not None:
                rejection = first_failure(point, outcome.value)
            if rejection is not None:
                return Tried(rejection)
            if point is not None and not worse:
                worse = worse_result(point, outcome.value)
    return Tried(None, worse)


def not_run(point: BenchPoint | None, outcome: Outcome) -> Rejection | None:
    """Return why an FMU could not be run at a point, None where it could."""
    if outcome.error is None:
        return None
    return Rejection(point_name(point) if point else "", "", str(outcome.error))


def first_failure(point: BenchPoint, measured: Sequence[Measurement]) -> Rejection | None:
    """Return the first check of an FMU's measurements at a point that fails."""
    for expect, got, expected in zip(point.scene.expect, measured, point.expected, strict=True):
        if got.applicable:
            check = compare(Comparison.of(expect), got, expected, point)
            if not check.passed:
                return Rejection(point_name(point), check.quantity, sentence(check))
    return None


def point_name(point: ScenePoint) -> str:
    """Return the name of the scene, and the point of its sweep."""
    return f"{point.scene.name}{place(point.at, ' at ')}"


def worse_result(point: BenchPoint, measured: Sequence[Measurement]) -> str:
    """Return the first result that is further off than the original's, "" where none is.

    Off its reference, that is, or nearer to its bound. What only one of them has counts, too.
    """
    results = zip(point.scene.expect, measured, point.original, point.expected, strict=True)
    for expect, got, original, expected in results:
        name = f"{expect.quantity} of {point_name(point)}"
        if got.value is None or original.value is None:
            if got.value is not original.value:
                return name
            continue
        comparison = Comparison.of(expect)
        bound = expect.at_least if expect.at_most is None else expect.at_most
        if bound is None:
            before = compare(comparison, original, expected, point).severity
        else:
            before, expected = 0.0, original.value
            comparison = replace(comparison, absolute=abs(bound))
        if compare(comparison, got, expected, point).severity > before + NEGLIGIBLE:
            return name
    return ""
