"""Measure at many scene points on an isolated FMU."""

from __future__ import annotations

from collections.abc import Callable, Generator, Sequence
from pathlib import Path
from typing import Any, TypeVar

from slider_resonator.checks.fmu_side import FmuSide, task_in_scene
from slider_resonator.fmu.isolation.tasks import Finished, run_tasks
from slider_resonator.scenes.scene import ScenePoint

Point = TypeVar("Point", bound=ScenePoint)


def measure_points(
    fmu: Path,
    points: Sequence[Point],
    measure: Callable[[FmuSide], Any],
    time_limit: float,
    meanwhile: Callable[[Point], None] = lambda point: None,
    jobs: int = 1,
) -> Generator[Finished[Point], None, None]:
    """Yield the result of `measure`, which must be picklable, at each point, or the error there.

    `meanwhile` is called for a point while the FMU is at work on it. Up to `jobs` processes of the
    FMU share the points, as `run_tasks` has it. After a crash or a missed
    `time_limit` (s) the other points of that scene are left out.
    """
    tasks = [(point, task_in_scene(point.scene, measure)) for point in points]
    return run_tasks(
        fmu,
        tasks,
        time_limit,
        name=lambda point: point.scene.name,
        meanwhile=meanwhile,
        jobs=jobs,
    )
