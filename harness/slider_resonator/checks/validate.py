"""Running scenes against FMUs, each in a process of its own, and collecting the verdicts."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter
from typing import Any

import numpy as np
from numpy.typing import NDArray

from slider_resonator.checks.compare import Check, Measurement, check, measure_all, wanted
from slider_resonator.checks.fmu_side import task_in_scene
from slider_resonator.checks.measures.tube import Tube
from slider_resonator.checks.natural_scale import smallest_reference
from slider_resonator.checks.quantities import QUANTITIES
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.errors import SceneError
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.fmu.isolation.tasks import run_tasks
from slider_resonator.scenes.scene import Scene, read_scene, sweep_points
from slider_resonator.scenes.schema import ExpectTable

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
        yield _Point(at, point, ReferenceSide(point))


class _Judge:
    """Runs the points on one FMU and keeps the verdicts."""

    def __init__(self, path: Path, time_limit: float) -> None:
        self.path = path
        self.time_limit = time_limit
        self.checks: list[Check] = []
        self.troubles: list[Trouble] = []
        self.curves: list[Curves] = []

    def validation(
        self, points: Sequence[_Point], told: Callable[[str, float], None]
    ) -> Validation:
        """Judge all points; the references are computed while the FMU is at work."""
        began = perf_counter()
        references: dict[int, list[Any]] = {}

        def meanwhile(point: _Point) -> None:
            told(point.scene.name, len(references) / len(points))
            references[id(point)] = [_wanted(e, point.reference) for e in point.scene.expect]

        tasks = [(point, task_in_scene(point.scene, measure_all)) for point in points]
        with closing(
            run_tasks(
                self.path,
                tasks,
                self.time_limit,
                name=lambda point: point.scene.name,
                meanwhile=meanwhile,
            )
        ) as finished:
            for one in finished:
                if one.error is not None:
                    self._trouble(one.error, one.item)
                elif one.item is not None:
                    self._judge(one.item, one.result, references[id(one.item)])
        return Validation(
            str(self.path),
            tuple(self.checks),
            perf_counter() - began,
            tuple(self.troubles),
            tuple(self.curves),
        )

    def _judge(
        self, point: _Point, measurements: Sequence[Measurement], references: Sequence[Any]
    ) -> None:
        for expect, measured, reference in zip(
            point.scene.expect, measurements, references, strict=True
        ):
            if isinstance(reference, SceneError):
                self._trouble(reference, point)
                continue
            smallest = smallest_reference(expect.quantity, point.scene.device)
            verdict = check(expect, measured, reference, point.scene.name, point.at, smallest)
            self.checks.append(verdict)
            curves = curves_of(verdict, measured, reference)
            if curves is not None:
                self.curves.append(curves)

    def _trouble(self, error: Exception, point: _Point | None) -> None:
        if point is None:
            self.troubles.append(trouble_of_fmu(self.path, error))
        else:
            self.troubles.append(Trouble(point.scene.name, str(error), point.at))


def _wanted(expect: ExpectTable, reference: ReferenceSide) -> Any:
    try:
        return wanted(expect, reference)
    except SceneError as error:
        return error


def trouble_of_fmu(path: Path, error: Exception) -> Trouble:
    """Return what is wrong with an FMU as a whole, with its file named."""
    text = str(error)
    return Trouble("", text if text.startswith(f"{path}") else f"{path}: {text}", {})


def curves_of(verdict: Check, measured: Measurement, reference: Any) -> Curves | None:
    """Return the signals behind a check that has failed, None for one that has none."""
    signal = QUANTITIES[verdict.quantity].kind == "signal"
    if not signal or verdict.passed or measured.times is None:
        return None
    middle = reference.middle if isinstance(reference, Tube) else reference
    return Curves(verdict, measured.times, measured.value, middle)


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
