"""Running one FMU over scenes until the first check that rejects it."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slider_resonator.checks.compare import Check, Measurement, check, measure_all
from slider_resonator.checks.fmu_side import FmuSide, task_in_scene
from slider_resonator.checks.measures.deviation import peak
from slider_resonator.checks.natural_scale import smallest_reference
from slider_resonator.checks.verdict import place, sentence
from slider_resonator.fmu.isolation.tasks import run_tasks
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.schema import ExpectTable

COURSES: Mapping[str, float | None] = {
    "mean_velocity": None,
    "stick_fraction": 1e-9,
    "reversals": 0.0,
    "last_event_time": 1e-9,
    "steady_velocity": None,
    "blocking_force": None,
}
"""Outputs that scenes expect something of at one time only, and by how much they may change, in
their unit; None stands for a share of the peak."""

Course = Mapping[str, NDArray[np.float64]]
"""Output to its values at the communication points, shape (n,)."""

_ANY = "located_events"
"""A reference that all of these have: it is not asked for what the original has said."""
_ROUNDING = 1e-12
"""m/s or N: what differs by less is rounding."""


@dataclass(frozen=True)
class Point:
    """A scene, or a point of its sweep, with what is wanted of it, one for each expectation.

    A `course` is wanted as well where there is one: at each communication point, up to
    `share` of an output's peak.
    """

    at: Mapping[str, float]
    scene: Scene
    wanted: tuple[Any, ...]
    course: Course = field(default_factory=dict)
    share: float = 0.0

    @property
    def name(self) -> str:
        """The scene, and where in its sweep it is."""
        return f"{self.scene.name}{place(self.at, ' at ')}"


@dataclass(frozen=True)
class Seen:
    """What an FMU gives at a point: a measurement for each expectation, and courses if asked."""

    measured: tuple[Measurement, ...]
    course: Course


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
    wants_course = any(point.course for point in points)
    measure = see if wants_course else _see_expected
    tasks = [(point, task_in_scene(point.scene, measure)) for point in points]
    with closing(run_tasks(fmu, tasks, time_limit, name=lambda point: point.name)) as finished:
        for one in finished:
            if one.error is not None or one.item is None:
                return Rejection(one.item.name if one.item else "", "", str(one.error))
            for verdict in _checks(one.item, one.result):
                if not verdict.passed:
                    return Rejection(one.item.name, verdict.quantity, sentence(verdict))
                if nearest is None or verdict.severity > nearest.severity:
                    nearest = verdict
    return Passed(nearest)


def see(fmu: FmuSide) -> Seen:
    """Measure what the scene expects, and read the course of the other outputs."""
    return Seen(measure_all(fmu), {name: fmu.record[name] for name in COURSES})


def _see_expected(fmu: FmuSide) -> Seen:
    return Seen(measure_all(fmu), {})


def _checks(point: Point, seen: Seen) -> Iterator[Check]:
    """Yield the verdicts on what exists in the FMU, or should."""
    for expect, measurement, wanted in zip(
        point.scene.expect, seen.measured, point.wanted, strict=True
    ):
        if measurement.value is not None or wanted is not None:
            smallest = smallest_reference(expect.quantity, point.scene.device)
            yield check(expect, measurement, wanted, point.scene.name, point.at, smallest)
    for name, wanted in point.course.items():
        allowed = COURSES[name]
        if allowed is None:
            allowed = point.share * peak(wanted) + _ROUNDING
        difference = np.abs(seen.course[name] - wanted)
        worst = int(np.argmax(np.where(np.isnan(difference), np.inf, difference)))
        expect = ExpectTable(quantity=name, reference=_ANY, absolute=allowed, why="as before")
        measurement = Measurement(float(seen.course[name][worst]))
        yield check(expect, measurement, float(wanted[worst]), point.scene.name, point.at)
