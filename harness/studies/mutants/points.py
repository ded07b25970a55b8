"""The points of a mutation run: built-in scenes against references, probes against the original."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from slider_resonator.checks.expecting import expected_value
from slider_resonator.checks.measure_points import measure_points
from slider_resonator.checks.reference_side import ReferenceSide
from slider_resonator.checks.validate import points_to_check
from slider_resonator.output.progress import Progress, counted
from slider_resonator.scenes.scene import Scene, read_scene
from studies.mutants.probes import allowed_share
from studies.mutants.trial import ExpectedPoint, Observed, observe


def scene_points(files: Sequence[Path], progress: Progress) -> list[ExpectedPoint]:
    """Return every scene and point of a sweep, with the values of its references.

    Raises SceneError for a scene that cannot be read, referred to or expects nothing.
    """
    points = []
    for index, file in enumerate(files):
        scene = read_scene(file)
        label = counted(f"references of {scene.name}", index, len(files))
        progress(label, index / len(files))
        for point in points_to_check(scene):
            references = ReferenceSide(point.scene)
            expected = tuple(expected_value(expect, references) for expect in scene.expect)
            points.append(ExpectedPoint(point.scene, point.at, expected))
    return points


def probe_points(fmu: Path, probes: Sequence[Scene], time_limit: float) -> list[ExpectedPoint]:
    """Return the probes with the results of the original FMU.

    Those that it refuses are left out: no mutant can differ from it there.
    """
    finished = measure_points(fmu, [ExpectedPoint(probe) for probe in probes], observe, time_limit)
    return [
        _expecting(one.item, one.result)
        for one in finished
        if one.item is not None and one.error is None
    ]


def _expecting(probe: ExpectedPoint, seen: Observed) -> ExpectedPoint:
    device = probe.scene.device
    return replace(
        probe,
        expected=tuple(measurement.value for measurement in seen.measured),
        outputs=seen.outputs,
        share=allowed_share(device.fidelity, device.friction_law),
    )
