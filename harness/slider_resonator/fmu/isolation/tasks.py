"""An FMU in many scenes: in a process of its own, and in another after each that it has ended."""

from __future__ import annotations

from collections.abc import Callable, Generator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Generic, Protocol, TypeVar

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.errors import FmuError
from slider_resonator.fmu.isolation.process import FmuDied, FmuProcess
from slider_resonator.scenes.scene import Scene

TIME_LIMIT = 120.0
"""Seconds for an FMU and a scene or point of a sweep; the slowest built-in one takes a few."""
MOST_DEATHS = 3
"""After so many crashes or missed time limits the rest of the scenes is not run."""


class Runnable(Protocol):
    """A scene, or a point of its sweep: the file, what is varied, and what comes of it."""

    @property
    def file(self) -> Path:
        """The scene's file."""

    @property
    def at(self) -> Mapping[str, float]:
        """What a sweep has varied."""

    @property
    def scene(self) -> Scene:
        """The scene, with that in it."""


PointType = TypeVar("PointType", bound=Runnable)


@dataclass(frozen=True)
class Ran(Generic[PointType]):
    """A point with its `result`, or the `error` that there is instead.

    Without a point the error is about the FMU as a whole.
    """

    point: PointType | None
    result: Any = None
    error: FmuError | None = None


def isolated_runs(
    fmu: Path,
    points: Sequence[PointType],
    measure: Callable[[FmuSide], Any],
    time_limit: float,
    meanwhile: Callable[[PointType], None] = lambda point: None,
) -> Generator[Ran[PointType], None, None]:
    """Yield what `measure`, a function of a module, gives at each point.

    `meanwhile` is called for a point while the FMU is at work on it. A scene in which the FMU has
    crashed or exceeded `time_limit` (s) is not gone on with, and after `MOST_DEATHS` none is.
    """
    process: FmuProcess | None = None
    deaths: list[Path] = []
    try:
        for index, point in enumerate(points):
            if point.file in deaths:
                continue
            if process is None:
                try:
                    process = FmuProcess(fmu, time_limit)
                except FmuError as error:
                    yield Ran(None, error=error)
                    return
            try:
                process.ask(point.file, point.at, measure)
                meanwhile(point)
                result = process.answer()
            except FmuError as error:
                process.kill()
                process = None
                if isinstance(error, FmuDied):
                    deaths.append(point.file)
                yield Ran(point, error=error)
            else:
                yield Ran(point, result)
            if len(deaths) == MOST_DEATHS:
                rest = [p.scene.name for p in points[index + 1 :] if p.file not in deaths]
                if rest:
                    yield Ran(None, error=_given_up(rest))
                return
        if process is not None:
            try:
                process.close()
            except FmuDied as error:
                yield Ran(None, error=error)
    finally:
        if process is not None:
            process.kill()


def _given_up(names: Sequence[str]) -> FmuError:
    rest = ", ".join(dict.fromkeys(names))
    return FmuError(f"given up after {MOST_DEATHS} crashes or missed time limits; not run: {rest}")
