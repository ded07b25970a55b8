"""What mutants are tried on: built-in scenes against references, probes against the original."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path

from slider_resonator.checks.compare import wanted
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.errors import SceneError
from slider_resonator.fmu.isolation.tasks import isolated_runs
from slider_resonator.scenes.scene import read_scene, sweep_points
from slider_resonator.trials.mutants.probes import allowed_share
from slider_resonator.trials.mutants.trial import Point, see


def scene_points(files: Sequence[Path], progress: Callable[[str, float], None]) -> list[Point]:
    """Return every scene and point of a sweep, with what its references say.

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
            told = tuple(wanted(expect, reference) for expect in point.expect)
            points.append(Point(file, at, point, told))
    return points


def probe_points(fmu: Path, files: Sequence[Path], time_limit: float) -> list[Point]:
    """Return the probes with what the original FMU gives.

    Those that it refuses are left out: no mutant can be told from it there.
    """
    asked = [Point(file, {}, read_scene(file), ()) for file in files]
    return [
        replace(
            ran.point,
            wanted=tuple(measurement.value for measurement in ran.result.measured),
            course=ran.result.course,
            share=allowed_share(ran.point.scene.device),
        )
        for ran in isolated_runs(fmu, asked, see, time_limit)
        if ran.point is not None and ran.error is None
    ]
