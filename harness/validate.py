"""Running scenes against FMUs, each in a process of its own, and collecting the verdicts."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from harness.compare import Check, check, wanted
from harness.errors import FmuError, SceneError
from harness.fmu_process import FmuDied, FmuProcess
from harness.measures.tube import Tube
from harness.natural_scale import smallest_reference
from harness.quantities import QUANTITIES
from harness.reference_side import ReferenceSide
from harness.scene import Scene, read_scene, sweep_points

TIME_LIMIT = 120.0
"""Seconds for an FMU and a scene or point of a sweep; the slowest built-in one takes a few."""
MOST_DEATHS = 3
"""After so many crashes or missed time limits the rest of the scenes is not run."""

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Trouble:
    """What could not be run: a scene, at a point of its sweep, or without a scene the whole FMU."""

    scene: str
    reason: str
    at: Mapping[str, float]


@dataclass(frozen=True)
class Curves:
    """The signals behind a failed check: `fmu` and `reference` at `times` (s), all shape (n,)."""

    check: Check
    times: Array
    fmu: Array
    reference: Array


@dataclass(frozen=True)
class Validation:
    """All verdicts on an FMU, in the order of the scenes, and the seconds that they took.

    `troubles` is what could not be judged, `curves` are the signals that differ.
    """

    fmu: str
    checks: tuple[Check, ...]
    wall_time: float
    troubles: tuple[Trouble, ...] = ()
    curves: tuple[Curves, ...] = ()

    @property
    def passed(self) -> bool:
        """True when everything could be judged and every check has passed."""
        return not self.troubles and all(check.passed for check in self.checks)

    @property
    def exit_code(self) -> int:
        """0 for a pass, 1 for a failed check, 2 when something could not be run."""
        return 2 if self.troubles else int(not self.passed)


@dataclass(frozen=True)
class _Point:
    """A scene, or one of the points of its sweep, with its references."""

    file: Path
    at: Mapping[str, float]
    scene: Scene
    reference: ReferenceSide


def validate(
    fmu_paths: Sequence[Path],
    scene_files: Sequence[Path],
    progress: Callable[[str, float], None] = lambda scene, share: None,
    *,
    time_limit: float = TIME_LIMIT,
) -> tuple[Validation, ...]:
    """Run every scene on every FMU and judge every expectation in it.

    The references are computed once for all FMUs; their time counts for the first. `progress` is
    told the scene at work and the share of all the work that is done. An FMU that does not answer
    within `time_limit` (s) for a scene, or point of a sweep, is ended. Raises SceneError when a
    scene file is at fault; what is wrong with an FMU is among its validation's troubles.
    """
    points = [point for path in scene_files for point in _points(path)]
    validations = []
    for turn, path in enumerate(fmu_paths):

        def told(name: str, share: float, turn: int = turn) -> None:
            progress(name, (turn + share) / len(fmu_paths))

        validations.append(_Judge(path, time_limit).validation(points, told))
    progress("", 1.0)
    return tuple(validations)


def _points(path: Path) -> Iterator[_Point]:
    scene = read_scene(path)
    if not scene.expect:
        raise SceneError(f"{path}: scene {scene.name} expects nothing: [[expect]] is missing")
    for at, point in sweep_points(scene, path):
        yield _Point(path, at, point, ReferenceSide(point))


class _Judge:
    """Runs the points on one FMU and keeps the verdicts."""

    def __init__(self, path: Path, time_limit: float) -> None:
        self.path = path
        self.start = partial(FmuProcess, path, time_limit)
        self.process: FmuProcess | None = None
        self.checks: list[Check] = []
        self.troubles: list[Trouble] = []
        self.curves: list[Curves] = []
        self.deaths: list[Path] = []

    def validation(
        self, points: Sequence[_Point], told: Callable[[str, float], None]
    ) -> Validation:
        """Judge all points; a scene that has ended the process is not gone on with."""
        began = perf_counter()
        try:
            self._judge_all(points, told)
        finally:
            if self.process is not None:
                self.process.kill()
        return Validation(
            str(self.path),
            tuple(self.checks),
            perf_counter() - began,
            tuple(self.troubles),
            tuple(self.curves),
        )

    def _judge_all(self, points: Sequence[_Point], told: Callable[[str, float], None]) -> None:
        for index, point in enumerate(points):
            told(point.scene.name, index / len(points))
            if point.file in self.deaths:
                continue
            if self.process is None:
                try:
                    self.process = self.start()
                except FmuError as error:
                    self._trouble(error)
                    return
            try:
                self._judge(self.process, point)
            except FmuError as error:
                self._trouble(error, point)
                self.process.kill()
                self.process = None
                if isinstance(error, FmuDied):
                    self.deaths.append(point.file)
            if len(self.deaths) == MOST_DEATHS:
                self._give_up(points[index + 1 :])
                return
        if self.process is not None:
            try:
                self.process.close()
            except FmuDied as error:
                self._trouble(error)

    def _judge(self, process: FmuProcess, point: _Point) -> None:
        """Judge a point; the references are computed while the FMU is at work."""
        process.ask(point.file, point.at)
        references: list[Any] = []
        for expect in point.scene.expect:
            try:
                references.append(wanted(expect, point.reference))
            except SceneError as error:
                references.append(error)
        for expect, measured, reference in zip(
            point.scene.expect, process.answer(), references, strict=True
        ):
            if isinstance(reference, SceneError):
                self._trouble(reference, point)
                continue
            smallest = smallest_reference(expect.quantity, point.scene.device)
            verdict = check(expect, measured, reference, point.scene.name, point.at, smallest)
            self.checks.append(verdict)
            signal = QUANTITIES[expect.quantity].kind == "signal"
            if signal and not verdict.passed and measured.times is not None:
                middle = reference.middle if isinstance(reference, Tube) else reference
                self.curves.append(Curves(verdict, measured.times, measured.value, middle))

    def _trouble(self, error: Exception, point: _Point | None = None) -> None:
        if point is None:
            text = str(error)
            told = text if text.startswith(f"{self.path}") else f"{self.path}: {text}"
            self.troubles.append(Trouble("", told, {}))
        else:
            self.troubles.append(Trouble(point.scene.name, str(error), point.at))

    def _give_up(self, rest: Sequence[_Point]) -> None:
        names = dict.fromkeys(p.scene.name for p in rest if p.file not in self.deaths)
        if names:
            reason = f"given up after {MOST_DEATHS} crashes or missed time limits; not run: "
            self._trouble(FmuError(reason + ", ".join(names)))


def worst_of_sweeps(checks: Sequence[Check]) -> list[tuple[Check, int]]:
    """Return the worst check of each expectation over its sweep, and how many there were."""
    groups: dict[tuple[str, str, str, str], list[Check]] = {}
    for item in checks:
        key = (item.scene, item.quantity, item.against, item.why)
        groups.setdefault(key, []).append(item)
    return [
        (max(group, key=lambda c: (not c.passed, c.severity)), len(group))
        for group in groups.values()
    ]
