"""Running an FMU over scenes up to the first check that rejects it."""

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

TRAJECTORY_OUTPUTS: Mapping[str, float | None] = {
    "mean_velocity": None,
    "stick_fraction": 1e-9,
    "reversals": 0.0,
    "last_event_time": 1e-9,
    "steady_velocity": None,
    "blocking_force": None,
}
"""Outputs that scenes check at one time only, with the allowed change in their unit; None stands
for a share of the peak."""

Outputs = Mapping[str, NDArray[np.float64]]
"""Output to its values at the communication points, shape (n,)."""

_ANY = "located_events"
"""A reference that all of these have; it is not run: the original gives the expected values."""
_ROUNDING = 1e-12
"""Differences that are rounding, m/s or N."""


@dataclass(frozen=True)
class Point:
    """A scene, or a point of its sweep, with an expected value for each expectation.

    `outputs` are expected as well where there are some: at each communication point, up to
    `share` of an output's peak.
    """

    at: Mapping[str, float]
    scene: Scene
    expected: tuple[Any, ...]
    outputs: Outputs = field(default_factory=dict)
    share: float = 0.0

    @property
    def name(self) -> str:
        """The scene, and where in its sweep it is."""
        return f"{self.scene.name}{place(self.at, ' at ')}"


@dataclass(frozen=True)
class Observed:
    """What an FMU gives at a point: a measurement for each expectation, and outputs if asked."""

    measured: tuple[Measurement, ...]
    outputs: Outputs


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
    reads_outputs = any(point.outputs for point in points)
    measure = observe if reads_outputs else _observe_expected
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


def observe(fmu: FmuSide) -> Observed:
    """Measure what the scene expects, and record the other outputs."""
    return Observed(measure_all(fmu), {name: fmu.record[name] for name in TRAJECTORY_OUTPUTS})


def _observe_expected(fmu: FmuSide) -> Observed:
    return Observed(measure_all(fmu), {})


def _checks(point: Point, seen: Observed) -> Iterator[Check]:
    """Yield the verdicts on what exists in the FMU, or should."""
    for expect, measurement, expected in zip(
        point.scene.expect, seen.measured, point.expected, strict=True
    ):
        if measurement.value is not None or expected is not None:
            smallest = smallest_reference(expect.quantity, point.scene.device)
            yield check(expect, measurement, expected, point.scene.name, point.at, smallest)
    for name, expected in point.outputs.items():
        allowed = TRAJECTORY_OUTPUTS[name]
        if allowed is None:
            allowed = point.share * peak(expected) + _ROUNDING
        difference = np.abs(seen.outputs[name] - expected)
        worst = int(np.argmax(np.where(np.isnan(difference), np.inf, difference)))
        expect = ExpectTable(quantity=name, reference=_ANY, absolute=allowed, why="as before")
        measurement = Measurement(float(seen.outputs[name][worst]))
        yield check(expect, measurement, float(expected[worst]), point.scene.name, point.at)
