"""Running one FMU over scenes until the first check that rejects it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from harness.compare import Check, Measurement, check, measure_all
from harness.isolated_runs import isolated_runs
from harness.natural_scale import smallest_reference
from harness.scene import Scene
from harness.verdict import place, sentence


@dataclass(frozen=True)
class Point:
    """A scene, or a point of its sweep, with what is wanted of it, one for each expectation."""

    file: Path
    at: Mapping[str, float]
    scene: Scene
    wanted: tuple[Any, ...]

    @property
    def name(self) -> str:
        """The scene, and where in its sweep it is."""
        return f"{self.scene.name}{place(self.at, ' at ')}"


@dataclass(frozen=True)
class Rejection:
    """Why an FMU was rejected: by which scene and quantity, in a sentence.

    Without a quantity it could not be run there; without a scene, nowhere.
    """

    scene: str
    quantity: str
    reason: str


@dataclass(frozen=True)
class Passed:
    """All checks have passed; `nearest` is the one that came nearest to its limit, if any did."""

    nearest: Check | None


def trial(fmu: Path, points: Sequence[Point], time_limit: float) -> Rejection | Passed:
    """Judge the points one after the other, in a process that may take `time_limit` (s) for each.

    Where the FMU crashes, hangs or refuses, that is a rejection as well.
    """
    nearest: Check | None = None
    runs = isolated_runs(fmu, points, measure_all, time_limit)
    with closing(runs):
        for ran in runs:
            if ran.error is not None or ran.point is None:
                return Rejection(ran.point.name if ran.point else "", "", str(ran.error))
            for verdict in _checks(ran.point, ran.result):
                if not verdict.passed:
                    return Rejection(ran.point.name, verdict.quantity, sentence(verdict))
                if nearest is None or verdict.severity > nearest.severity:
                    nearest = verdict
    return Passed(nearest)


def _checks(point: Point, measured: Sequence[Measurement]) -> Iterator[Check]:
    """Yield the verdicts on what exists in the FMU, or should."""
    for expect, measurement, wanted in zip(point.scene.expect, measured, point.wanted, strict=True):
        if measurement.value is not None or wanted is not None:
            smallest = smallest_reference(expect.quantity, point.scene.device)
            yield check(expect, measurement, wanted, point.scene.name, point.at, smallest)
