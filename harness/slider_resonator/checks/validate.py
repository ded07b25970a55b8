"""Run scenes on isolated FMUs and compare the results with the references."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from time import perf_counter
from typing import Any

from slider_resonator.arrays import Array
from slider_resonator.checks.compare import Check, Comparison, compare
from slider_resonator.checks.expecting import expected_value
from slider_resonator.checks.measure_points import measure_points
from slider_resonator.checks.measures.tube import Tube
from slider_resonator.checks.measuring import Measurement, measure_all
from slider_resonator.checks.overview import Overview, overview_of
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.errors import SceneError
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.fmu.opening import lacking
from slider_resonator.fmu.provenance import FmuIdentity, Provenance, identity_of, provenance_of
from slider_resonator.output.console import counted
from slider_resonator.scenes.scene import Scene, ScenePoint, read_scene
from slider_resonator.scenes.vocabulary import QUANTITIES


@dataclass(frozen=True)
class RunFailure:
    """A scene or point that could not be run; an empty `scene` means the whole FMU."""

    scene: str
    reason: str
    at: Mapping[str, float]

    @classmethod
    def of(cls, fmu: Path, point: ScenePoint | None, error: Exception | None) -> RunFailure:
        """Return the failure at a point; without a point that of the FMU, with its file name."""
        text = str(error)
        if point is not None:
            return cls(point.scene.name, text, point.at)
        return cls("", text if text.startswith(f"{fmu}") else f"{fmu}: {text}", {})


@dataclass(frozen=True)
class NotApplied:
    """A check that the FMU lacks something for, which it may lack: neither passed nor failed."""

    scene: str
    quantity: str
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
    """All checks of an FMU, in the order of the scenes, and the wall time in s.

    `identity` is that of the FMU's file when the run began, `overviews` show the first point of
    each scene that has a signal.

    `run_failures` are scenes that could not be run, `curves` the signals that differ. `lacks` are
    the later variables of the interface that the FMU does not have, `not_applied` the checks that
    say nothing about it.
    """

    fmu: str
    checks: tuple[Check, ...]
    wall_time: float
    run_failures: tuple[RunFailure, ...] = ()
    curves: tuple[Curves, ...] = ()
    lacks: tuple[str, ...] = ()
    not_applied: tuple[NotApplied, ...] = ()
    identity: FmuIdentity | None = None
    overviews: tuple[Overview, ...] = ()

    @property
    def passed(self) -> bool:
        """True when every scene could be run and every check that applies has passed."""
        return self.exit_code == 0

    @property
    def exit_code(self) -> int:
        """0 for a pass, 1 for a failed check, 2 when a scene could not run or nothing applies."""
        if self.run_failures or not self.checks:
            return 2
        return int(not all(check.passed for check in self.checks))


def validate(
    fmu_paths: Sequence[Path],
    scene_files: Sequence[Path],
    progress: Callable[[str, float], None] = lambda scene, share: None,
    *,
    time_limit: float = TIME_LIMIT,
) -> tuple[Validation, ...]:
    """Compare each FMU with the references in every scene and at every point of its sweep.

    Expected values are computed once for all FMUs; their time counts for the first. `progress`
    gets the scene at work and the share of all the work that is done. An FMU that does not answer
    within `time_limit` (s) for a point is stopped. Raises SceneError for a faulty scene file; what
    is wrong with an FMU is among the run failures of its validation.
    """
    points = [point for file in scene_files for point in points_to_check(read_scene(file))]
    expected = ExpectedValues()
    validations = []
    for number, path in enumerate(fmu_paths):

        def report(name: str, share: float, number: int = number) -> None:
            progress(name, (number + share) / len(fmu_paths))

        validations.append(_validation(path, points, expected, time_limit, report))
    progress("", 1.0)
    return tuple(validations)


def points_to_check(scene: Scene) -> tuple[ScenePoint, ...]:
    """Return the points of a scene; SceneError for a scene without expectations."""
    if not scene.expect:
        raise SceneError(
            f"{scene.source}: scene {scene.name} expects nothing: [[expect]] is missing"
        )
    return scene.points()


class ExpectedValues:
    """The expected values of scenes at their points, each computed once."""

    def __init__(self) -> None:
        self._values: dict[ScenePoint, list[Any]] = {}

    def at(self, point: ScenePoint) -> list[Any]:
        """Return a value for each expectation, or the SceneError where there is none."""
        if point not in self._values:
            references = ReferenceSide(point.scene)
            values: list[Any] = []
            for expect in point.scene.expect:
                try:
                    values.append(expected_value(expect, references))
                except SceneError as error:
                    values.append(error)
            self._values[point] = values
        return self._values[point]


def _validation(
    path: Path,
    points: Sequence[ScenePoint],
    expected: ExpectedValues,
    time_limit: float,
    report: Callable[[str, float], None],
) -> Validation:
    """Run the points on one FMU and judge; expected values are computed while it runs."""
    began = perf_counter()
    identity = identity_of(path)
    number = count()

    def meanwhile(point: ScenePoint) -> None:
        done = next(number)
        report(counted(point.scene.name, done, len(points)), done / len(points))
        expected.at(point)

    checks: list[Check] = []
    run_failures: list[RunFailure] = []
    curves: list[Curves | None] = []
    not_applied: list[NotApplied] = []
    overviews: dict[str, Overview | None] = {}
    with closing(measure_points(path, points, measure_all, time_limit, meanwhile)) as finished:
        for one in finished:
            point = one.item
            if one.error is not None or point is None:
                run_failures.append(RunFailure.of(path, point, one.error))
                continue
            values = expected.at(point)
            judged: list[tuple[Check, Measurement, object]] = []
            for expect, measured, value in zip(point.scene.expect, one.result, values, strict=True):
                if not measured.applicable:
                    place = (point.scene.name, expect.quantity, measured.note, point.at)
                    not_applied.append(NotApplied(*place))
                elif isinstance(value, SceneError):
                    run_failures.append(RunFailure.of(path, point, value))
                else:
                    checks.append(compare(Comparison.of(expect), measured, value, point))
                    curves.append(curves_of(checks[-1], measured, value))
                    judged.append((checks[-1], measured, value))
            if point.scene.name not in overviews:
                overviews[point.scene.name] = overview_of(judged)
    return Validation(
        str(path),
        tuple(checks),
        perf_counter() - began,
        tuple(run_failures),
        tuple(curve for curve in curves if curve is not None),
        lacking(path),
        tuple(not_applied),
        identity,
        tuple(overview for overview in overviews.values() if overview is not None),
    )


def provenance_of_all(validations: Sequence[Validation]) -> Provenance:
    """Return the provenance of the verdicts on some FMUs."""
    return provenance_of(*(v.identity or identity_of(v.fmu) for v in validations))


def curves_of(check: Check, measured: Measurement, expected: Any) -> Curves | None:
    """Return the signals behind a failed check, None where it has passed or has no signal."""
    signal = QUANTITIES[check.quantity].kind == "signal"
    if not signal or check.passed or measured.times is None:
        return None
    middle = expected.middle if isinstance(expected, Tube) else expected
    return Curves(check, measured.times, measured.value, middle)


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
