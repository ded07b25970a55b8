"""Running one FMU over scenes until the first check that rejects it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from harness.compare import Check, check
from harness.errors import FmuError
from harness.fmu_process import FmuProcess
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
    try:
        process = FmuProcess(fmu, time_limit)
    except FmuError as error:
        return Rejection("", "", str(error))
    nearest: Check | None = None
    try:
        for point in points:
            try:
                process.ask(point.file, point.at)
                measured = process.answer()
            except FmuError as error:
                return Rejection(point.name, "", str(error))
            for expect, measurement, wanted in zip(
                point.scene.expect, measured, point.wanted, strict=True
            ):
                if measurement.value is None and wanted is None:
                    continue
                smallest = smallest_reference(expect.quantity, point.scene.device)
                verdict = check(expect, measurement, wanted, point.scene.name, point.at, smallest)
                if not verdict.passed:
                    return Rejection(point.name, verdict.quantity, sentence(verdict))
                if nearest is None or verdict.severity > nearest.severity:
                    nearest = verdict
        process.close()
    except FmuError as error:
        return Rejection("", "", str(error))
    finally:
        process.kill()
    return Passed(nearest)
