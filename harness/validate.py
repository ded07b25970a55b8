"""Running scenes against an FMU and collecting the verdicts."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import ExitStack
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
    fmu_paths: Sequence[Path],
    scene_files: Sequence[Path],
    progress: Callable[[str, float], None] = lambda scene, share: None,
) -> tuple[Validation, ...]:
    """Run every scene on every FMU and judge every expectation in it.

    The references are computed once for all FMUs; their time counts for the first. `progress` is
    told the scene at work and the share of all the work that is done. Raises HarnessError when
    something cannot be run, before any scene is run if a file is at fault.
    """
    scenes = [(path, read_scene(path)) for path in scene_files]
    for path, scene in scenes:
        if not scene.expect:
            raise SceneError(f"{path}: scene {scene.name} expects nothing: [[expect]] is missing")
    points = [
        (scene.name, at, point) for path, scene in scenes for at, point in sweep_points(scene, path)
    ]
    references = [ReferenceSide(point) for _, _, point in points]
    validations = []
    with ExitStack() as stack:
        fmus = [stack.enter_context(open_fmu(path)) for path in fmu_paths]
        for turn, (path, fmu) in enumerate(zip(fmu_paths, fmus, strict=True)):
            began = perf_counter()
            checks: list[Check] = []
            with instantiate(fmu) as instance:
                for index, ((name, at, point), side) in enumerate(
                    zip(points, references, strict=True)
                ):
                    progress(name, (turn + index / len(points)) / len(fmus))
                    fmu_side = FmuSide(instance, point)
                    checks += [check(e, fmu_side, side, at) for e in point.expect]
            validations.append(Validation(str(path), tuple(checks), perf_counter() - began))
    progress("", 1.0)
    return tuple(validations)


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
