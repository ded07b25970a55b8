"""Running scenes against an FMU and collecting the verdicts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from harness.compare import Check, check
from harness.drive import instantiate
from harness.errors import SceneError
from harness.fmu import open_fmu
from harness.fmu_side import FmuSide
from harness.reference_side import ReferenceSide
from harness.scene import read_scene, sweep_points


@dataclass(frozen=True)
class Validation:
    """All verdicts on an FMU, in the order of the scenes, and the seconds that they took."""

    fmu: str
    checks: tuple[Check, ...]
    wall_time: float

    @property
    def passed(self) -> bool:
        """True when every check has passed."""
        return all(check.passed for check in self.checks)


def validate(
    fmu_path: Path,
    scene_files: Sequence[Path],
    progress: Callable[[str, float], None] = lambda scene, share: None,
) -> Validation:
    """Run every scene and judge every expectation in it.

    `progress` is told the scene at work and the share of all the work that is done. Raises
    HarnessError when something cannot be run, before any scene is run if a file is at fault.
    """
    began = perf_counter()
    scenes = [(path, read_scene(path)) for path in scene_files]
    for path, scene in scenes:
        if not scene.expect:
            raise SceneError(f"{path}: scene {scene.name} expects nothing: [[expect]] is missing")
    points = [
        (scene.name, at, point) for path, scene in scenes for at, point in sweep_points(scene, path)
    ]
    checks: list[Check] = []
    with open_fmu(fmu_path) as fmu, instantiate(fmu) as instance:
        for index, (name, at, point) in enumerate(points):
            progress(name, index / len(points))
            fmu_side, reference_side = FmuSide(instance, point), ReferenceSide(point)
            checks += [check(e, fmu_side, reference_side, at) for e in point.expect]
    progress("", 1.0)
    return Validation(str(fmu_path), tuple(checks), perf_counter() - began)


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
