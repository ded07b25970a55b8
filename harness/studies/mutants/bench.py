"""The scene points at which variants of an FMU are judged, and what the unchanged one gives."""

import time
from collections.abc import Sequence
from contextlib import closing
from dataclasses import dataclass, replace
from pathlib import Path

from slider_resonator.checks.expecting import ExpectedValues
from slider_resonator.checks.fmu_side import FmuSide, measure_points
from slider_resonator.checks.measuring import Measurement, measure_all
from slider_resonator.checks.validate import points_to_check
from slider_resonator.errors import FmuError, SceneError
from slider_resonator.output.progress import Progress, counted, no_progress
from slider_resonator.scenes.scene import Scene
from studies.mutants.trial import BenchPoint, Rejection, first_failure, not_run, point_name

TIME_LIMIT = 30.0
"""Seconds for a variant and a scene or point of a sweep; the slowest built-in one takes a few."""


@dataclass(frozen=True)
class Judging:
    """The scenes to judge by, in `jobs` processes that may take `time_limit` (s) for each point.

    `journal` is the file that keeps verdicts.
    """

    scenes: Sequence[Scene]
    jobs: int = 1
    time_limit: float = TIME_LIMIT
    journal: Path | None = None
    progress: Progress = no_progress


def bench_of(fmu: Path, judging: Judging) -> list[BenchPoint]:
    """Return all points of the scenes, after running the unchanged FMU there.

    Raises FmuError when it is rejected, since the rejection of a variant would prove nothing then,
    and SceneError for a scene that cannot be referred to or expects nothing.
    """
    points = [
        BenchPoint(point.scene, point.at)
        for scene in judging.scenes
        for point in points_to_check(scene)
    ]
    bench: list[BenchPoint] = []
    limit, jobs = judging.time_limit, judging.jobs
    with (
        ExpectedValues(points, jobs) as expected,
        closing(measure_points(fmu, points, _timed, limit, jobs)) as outcomes,
    ):
        for at, outcome in outcomes:
            rejection = not_run(at, outcome)
            if rejection is None and at is not None:
                measured, cost = outcome.value
                values = expected.at(at)
                for error in values:
                    if isinstance(error, SceneError):
                        raise error
                point = replace(at, expected=tuple(values), original=measured, cost=cost)
                rejection = first_failure(point, measured)
                bench.append(point)
                label = counted(f"{point_name(point)} unchanged", len(bench) - 1, len(points))
                judging.progress(label, len(bench) / len(points))
            if rejection is not None:
                raise _rejected_unchanged(fmu, rejection)
    return bench


def _timed(side: FmuSide) -> tuple[tuple[Measurement, ...], float]:
    began = time.process_time()
    return measure_all(side), time.process_time() - began


def _rejected_unchanged(fmu: Path, rejection: Rejection) -> FmuError:
    where = f"scene {rejection.scene}: " if rejection.scene else ""
    what = f"{rejection.quantity}: " if rejection.quantity else ""
    return FmuError(
        f"{fmu.name} is rejected before anything is changed: {where}{what}{rejection.reason}"
    )
