"""Run scenes on isolated FMUs and compare the results with the references."""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, fields, replace
from pathlib import Path
from time import perf_counter
from typing import Any

from slider_resonator.checks.compare import (
    Check,
    Comparison,
    Curves,
    compare,
    curves_of,
    overview_of,
)
from slider_resonator.checks.expecting import ExpectedValues
from slider_resonator.checks.fmu_side import FmuSide, Point, measure_points
from slider_resonator.checks.measuring import Measurement, measure_all
from slider_resonator.checks.verdict import place, sentence, title
from slider_resonator.errors import SceneError
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.fmu.opening import lacking
from slider_resonator.fmu.provenance import FmuIdentity, Provenance, identity_of, provenance_of
from slider_resonator.output.progress import Progress, counted, no_progress, part_of
from slider_resonator.output.readable import number_of
from slider_resonator.output.shown import Shown, Tabular
from slider_resonator.scenes.scene import Scene, ScenePoint


@dataclass(frozen=True)
class RunFailure:
    """A scene or point that could not be run; an empty `scene` means the whole FMU."""

    scene: str
    reason: str
    at: Mapping[str, float]

    @property
    def where(self) -> str:
        """Scene and point, with a colon; empty where it is the whole FMU."""
        return f"{self.scene}{place(self.at, ' at ')}: " if self.scene else ""

    @classmethod
    def of(cls, fmu: Path, point: ScenePoint | None, error: Exception | None) -> "RunFailure":
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


@dataclass(frozen=True, repr=False)
class Validation(Shown, Tabular):
    """All checks of an FMU, in the order of the scenes, and the wall time in s.

    `identity` is that of the FMU's file when the run began, `overviews` show the first point of
    each scene that has a signal.

    `run_failures` are scenes that could not be run, `curves` the signals that differ. `lacks` are
    the later variables of the interface that the FMU does not have, `not_applied` the checks that
    say nothing about it. `others_judged` says that another FMU of the run had checks.
    """

    fmu: str
    checks: tuple[Check, ...]
    wall_time: float
    run_failures: tuple[RunFailure, ...] = ()
    curves: tuple[Curves, ...] = ()
    lacks: tuple[str, ...] = ()
    not_applied: tuple[NotApplied, ...] = ()
    identity: FmuIdentity | None = None
    overviews: tuple[Curves, ...] = ()
    others_judged: bool = False

    @property
    def passed(self) -> bool:
        """True when every scene could be run and every check that applies has passed."""
        return self.exit_code == 0

    @property
    def exit_code(self) -> int:
        """0 for a pass, 1 for a failed check, 2 when a scene could not run.

        Also 2 where no check applies, unless another FMU of the run had checks.
        """
        if self.run_failures or not (self.checks or self.others_judged):
            return 2
        return int(bool(self.failed))

    @property
    def outcome(self) -> str:
        """The verdict in words."""
        if not (self.checks or self.run_failures):
            return f"none of {number_of(len(self.not_applied), 'check')} applies"
        return ("pass", "fail", "could not be run")[self.exit_code]

    @property
    def count(self) -> str:
        """How many checks passed, in what time."""
        total = len(self.checks)
        passed = f"{total - len(self.failed)} of {total} checks passed"
        return f"{passed} in {self.wall_time:.1f} s"

    @property
    def failed(self) -> list[Check]:
        """The checks that have failed."""
        return [check for check in self.checks if not check.passed]

    @property
    def scenes(self) -> dict[str, list[Check]]:
        """The checks by scene."""
        scenes: dict[str, list[Check]] = {}
        for check in self.checks:
            scenes.setdefault(check.scene, []).append(check)
        return scenes

    @property
    def without(self) -> str:
        """What the FMU lacks and how many checks do not apply to it, "" for neither."""
        parts = []
        if self.lacks:
            parts.append(
                f"judged without {', '.join(self.lacks)}, which came with a later interface"
            )
        if count := len(self.not_applied):
            parts.append(f"{count} {'check does' if count == 1 else 'checks do'} not apply")
        return "; ".join(parts)

    @property
    def inapplicable(self) -> list[tuple[str, str, str]]:
        """Scene with its point, quantity and reason of each check that does not apply."""
        return [
            (f"{one.scene}{place(one.at, ' at ')}", one.quantity, one.reason)
            for one in self.not_applied
        ]

    def table(self) -> dict[str, list[Any]]:
        """Return the checks in columns."""
        columns = [one.name for one in fields(Check)]
        return {name: [getattr(check, name) for check in self.checks] for name in columns}

    def describe(self) -> list[str]:
        """Return the verdict, and a line for each scene that could not run and failed check."""
        return [
            f"{self.outcome}: {self.count}",
            self.fmu,
            *([self.without] if self.without else []),
            *(f"could not run: {one.where}{one.reason}" for one in self.run_failures),
            *(f"FAIL {check.scene}: {title(check)}: {sentence(check)}" for check in self.failed),
        ]


def validate(
    fmu_paths: Sequence[Path],
    scenes: Sequence[Scene],
    progress: Progress = no_progress,
    *,
    time_limit: float = TIME_LIMIT,
    jobs: int = 1,
) -> tuple[Validation, ...]:
    """Compare each FMU with the references in every scene and at every point of its sweep.

    Expected values are computed once for all FMUs, by up to `jobs` processes while the FMUs run; an
    FMU that shows no fault runs in up to `jobs` processes. The verdicts and their order are those
    with 1. `progress` gets the scene that is judged and the share of the work done. An FMU that
    does not answer within `time_limit` (s) for a point is stopped. Raises SceneError for a scene
    that expects nothing; what is wrong with an FMU is among the run failures of its validation.
    """
    points = [point for scene in scenes for point in points_to_check(scene)]

    def judge(point: ScenePoint, measured: Sequence[Measurement]) -> Iterator[Judged]:
        comparisons = map(Comparison.of, point.scene.expect)
        return zip(comparisons, measured, expected.at(point), strict=True)

    validations = []
    with ExpectedValues(points, jobs) as expected:
        for index, path in enumerate(fmu_paths):
            part = part_of(progress, index, len(fmu_paths))
            judged = judge_points(path, points, measure_all, judge, part, time_limit, jobs)
            validations.append(judged)
    progress("", 1.0)
    is_judged = any(one.checks for one in validations)
    return tuple(replace(one, others_judged=is_judged) for one in validations)


def points_to_check(scene: Scene) -> tuple[ScenePoint, ...]:
    """Return the points of a scene; SceneError for a scene without expectations."""
    if not scene.expect:
        raise SceneError(
            f"{scene.source}: scene {scene.name} expects nothing: [[expect]] is missing"
        )
    return scene.points()


Judged = tuple[Comparison, Measurement, Any]
"""A comparison, the measurement and the expected value, or the SceneError where there is none."""


def judge_points(
    path: Path,
    points: Sequence[Point],
    measure: Callable[[FmuSide], Any],
    judge: Callable[[Point, Any], Iterable[Judged]],
    progress: Progress,
    time_limit: float,
    jobs: int = 1,
) -> Validation:
    """Run an FMU at all points, and judge each while it runs at the next ones.

    `judge` gets a point and what `measure` gives there; a SceneError of it is a run failure.
    """
    began, identity = perf_counter(), identity_of(path)
    checks, curves = list[Check](), list[Curves]()
    run_failures, not_applied = list[RunFailure](), list[NotApplied]()
    overviews = dict[str, Curves]()
    with closing(measure_points(path, points, measure, time_limit, jobs)) as outcomes:
        for done, (point, outcome) in enumerate(outcomes):
            if point is not None:
                progress(counted(point.scene.name, done, len(points)), done / len(points))
            if point is None or outcome.error is not None:
                run_failures.append(RunFailure.of(path, point, outcome.error))
                continue
            name, at, signals = point.scene.name, point.at, list[Curves]()
            try:
                judged = list(judge(point, outcome.value))
            except SceneError as error:
                run_failures.append(RunFailure.of(path, point, error))
                continue
            for comparison, measured, expected in judged:
                if not measured.applicable:
                    not_applied.append(NotApplied(name, comparison.quantity, measured.note, at))
                elif isinstance(expected, SceneError):
                    run_failures.append(RunFailure.of(path, point, expected))
                else:
                    check = compare(comparison, measured, expected, point)
                    checks.append(check)
                    if shown := curves_of(check, measured, expected):
                        signals.append(shown)
            curves += [shown for shown in signals if not shown.check.passed]
            if name not in overviews and (overview := overview_of(signals)):
                overviews[name] = overview
    return Validation(
        str(path),
        tuple(checks),
        perf_counter() - began,
        tuple(run_failures),
        tuple(curves),
        lacking(path),
        tuple(not_applied),
        identity,
        tuple(overviews.values()),
    )


def provenance_of_all(validations: Sequence[Validation]) -> Provenance:
    """Return the provenance of the verdicts on some FMUs."""
    return provenance_of(*(v.identity or identity_of(v.fmu) for v in validations))


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
