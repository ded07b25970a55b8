"""Running an FMU in scenes for the results that a baseline keeps or checks."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from itertools import count
from pathlib import Path

from slider_resonator.checks.measure_points import measure_points
from slider_resonator.checks.validate import RunFailure
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.scenes.scene import Scene, ScenePoint
from slider_resonator.trials.baseline.golden import Golden, measure_golden
from slider_resonator.trials.baseline.provenance import provenance
from slider_resonator.trials.baseline.store import At, Recorded, key

Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class Measured:
    """The results of an FMU by the source of the scene, and what could not be run."""

    scenes: Mapping[str, Recorded]
    run_failures: tuple[RunFailure, ...]


def measure_scenes(
    fmu: Path, scenes: Sequence[Scene], folder: Path, progress: Progress, time_limit: float
) -> Measured:
    """Run every scene and point of a sweep; a scene that fails at a point is left out.

    `folder` is where the results are to be kept. Raises FmuError for a file that is no FMU.
    """
    points = {scene.source: scene.points() for scene in scenes}
    all_points = [point for some in points.values() for point in some]
    found: dict[str, dict[At, Golden]] = {source: {} for source in points}
    run_failures: list[RunFailure] = []
    number = count()

    def meanwhile(point: ScenePoint) -> None:
        progress(point.scene.name, next(number) / len(all_points))

    with open_fmu(fmu) as opened:
        origins = {scene.source: provenance(opened, scene, folder) for scene in scenes}
        runs = measure_points(fmu, all_points, measure_golden, time_limit, meanwhile)
        with closing(runs) as finished:
            for one in finished:
                if one.error is not None or one.item is None:
                    run_failures.append(RunFailure.of(fmu, one.item, one.error))
                else:
                    found[one.item.scene.source][key(one.item.at)] = one.result
    progress("", 1.0)
    return Measured(
        {
            source: Recorded(found[source], origins[source])
            for source in points
            if len(found[source]) == len(points[source])
        },
        tuple(run_failures),
    )
