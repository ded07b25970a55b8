"""What mutants are tried on: built-in scenes against references, probes against the original."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from slider_resonator.checks.compare import wanted
from slider_resonator.checks.fmu_side import task_in_scene
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.errors import SceneError
from slider_resonator.fmu.isolation.tasks import run_tasks
from slider_resonator.scenes.scene import read_scene, sweep_points
from slider_resonator.trials.mutants.probes import allowed_share
from slider_resonator.trials.mutants.trial import Point, observe


def scene_points(files: Sequence[Path], progress: Callable[[str, float], None]) -> list[Point]:
    """Return every scene and point of a sweep, with what its references give.

    Raises SceneError for a scene that cannot be read, referred to or expects nothing.
    """
    points = []
    for index, file in enumerate(files):
        scene = read_scene(file)
        progress(f"references of {scene.name}", index / len(files))
        if not scene.expect:
            raise SceneError(f"{file}: scene {scene.name} expects nothing: [[expect]] is missing")
        for at, point in sweep_points(scene, file):
            reference = ReferenceSide(point)
            expected = tuple(wanted(expect, reference) for expect in point.expect)
            points.append(Point(at, point, expected))
    return points


def probe_points(fmu: Path, files: Sequence[Path], time_limit: float) -> list[Point]:
    """Return the probes with what the original FMU gives.

    Those that it refuses are left out: no mutant can differ from it there.
    """
    points = [Point({}, read_scene(file), ()) for file in files]
    tasks = [(point, task_in_scene(point.scene, observe)) for point in points]
    return [
        replace(
            one.item,
            expected=tuple(measurement.value for measurement in one.result.measured),
            outputs=one.result.outputs,
            share=allowed_share(one.item.scene.device),
        )
        for one in run_tasks(fmu, tasks, time_limit, name=lambda point: point.name)
        if one.item is not None and one.error is None
    ]
