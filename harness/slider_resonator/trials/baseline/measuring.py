"""Running an FMU in scenes to see what is to be recorded, or has been."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from slider_resonator.checks.fmu_side import task_in_scene
from slider_resonator.checks.validate import Trouble, trouble_of_fmu
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.tasks import run_tasks
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.scenes.scene import Scene, read_scene, sweep_points
from slider_resonator.trials.baseline.golden import Golden, measure_golden
from slider_resonator.trials.baseline.provenance import provenance
from slider_resonator.trials.baseline.store import At, Recorded, key

Progress = Callable[[str, float], None]


@dataclass(frozen=True)
class _Point:
    """A scene, or a point of its sweep."""

    file: Path
    at: Mapping[str, float]
    scene: Scene


@dataclass(frozen=True)
class Measured:
    """What an FMU gave in each scene that could be run to its end, and what could not be run."""

    scenes: Mapping[Path, Recorded]
    troubles: tuple[Trouble, ...]


def measure_scenes(
    fmu: Path, files: Sequence[Path], folder: Path, progress: Progress, time_limit: float
) -> Measured:
    """Run every scene and point of a sweep; a scene that does not get to its end is left out.

    `folder` is where the results are to be kept. Raises FmuError for a file that is no FMU.
    """
    points = [
        _Point(file, at, scene)
        for file in files
        for at, scene in sweep_points(read_scene(file), file)
    ]
    found: dict[Path, dict[At, Golden]] = {}
    troubles: list[Trouble] = []
    told = 0

    def meanwhile(point: _Point) -> None:
        nonlocal told
        progress(point.scene.name, told / len(points))
        told += 1

    with open_fmu(fmu) as opened:
        told_of = {file: provenance(opened, read_scene(file), folder) for file in files}
        tasks = [(point, task_in_scene(point.scene, measure_golden)) for point in points]
        with closing(
            run_tasks(
                fmu,
                tasks,
                time_limit,
                name=lambda point: point.scene.name,
                meanwhile=meanwhile,
            )
        ) as finished:
            for one in finished:
                point = one.item
                if point is None:
                    troubles.append(trouble_of_fmu(fmu, one.error or HarnessError()))
                elif one.error is not None:
                    troubles.append(Trouble(point.scene.name, str(one.error), point.at))
                else:
                    found.setdefault(point.file, {})[key(point.at)] = one.result
    progress("", 1.0)
    whole = {file for file in files if len(found.get(file, ())) == _count(points, file)}
    return Measured(
        {file: Recorded(found[file], told_of[file]) for file in files if file in whole},
        tuple(troubles),
    )


def _count(points: Sequence[_Point], file: Path) -> int:
    return sum(point.file == file for point in points)
