"""The three commands of a baseline: record golden results, check an FMU, accept changes."""

import shutil
from collections.abc import Sequence
from contextlib import closing
from pathlib import Path
from time import perf_counter

from slider_resonator.baseline.judge import TOLERANCE, Golden, compare_golden, measure_golden
from slider_resonator.baseline.store import (
    BUILT_IN,
    FMU_DIGEST,
    SCENE_DIGEST,
    SCENE_FILE,
    At,
    Recorded,
    key,
    provenance,
    read_recorded,
    recorded_scenes,
    replace_folder,
    scene_digest,
    write_recorded,
)
from slider_resonator.checks.compare import Check, Curves
from slider_resonator.checks.fmu_side import measure_points
from slider_resonator.checks.validate import NotApplied, RunFailure, Validation
from slider_resonator.errors import HarnessError, NotApplicable, SceneError, explained, unknown_name
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.provenance import digest_of, identity_of
from slider_resonator.output.files import make_folder, write_text
from slider_resonator.output.progress import Progress, counted, no_progress
from slider_resonator.scenes.scene import Scene
from slider_resonator.scenes.scene_files import built_in_scenes, find_scene

CHANGED = ".changed"
"""Folder beside the scenes with the changed results of the last check; git ignores it."""


def record(
    fmu: Path,
    scenes: Sequence[Scene],
    folder: Path,
    progress: Progress = no_progress,
    *,
    must_apply: bool = True,
    replace: bool = False,
    time_limit: float = TIME_LIMIT,
) -> tuple[tuple[str, ...], tuple[RunFailure, ...]]:
    """Record scenes; return the names of those written and the run failures.

    A scene that does not apply to the FMU is a run failure, without `must_apply` it is left out.
    Raises HarnessError, before anything is run, where a scene is recorded already and `replace` is
    not set, where two scenes have one name, and for a folder that cannot be made; FmuError for a
    file that is no FMU.
    """
    names = [scene.name for scene in scenes]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise SceneError(f"several scenes are called {', '.join(twice)}; must be only one")
    there = [name for name in names if (folder / name).exists()]
    if there and not replace:
        raise HarnessError(
            f"{folder}: recorded already: {', '.join(there)}; must be "
            "new scenes, or --replace to record them again"
        )
    measured, run_failures, not_applied = _measure(fmu, scenes, folder, progress, time_limit)
    if must_apply:
        run_failures += [RunFailure(one.scene, one.reason, one.at) for one in not_applied]
    whole = [scene for scene in scenes if scene.source in measured]
    for scene in whole:
        write_recorded(folder / scene.name, measured[scene.source])
        shutil.rmtree(folder / CHANGED / scene.name, ignore_errors=True)
    return tuple(scene.name for scene in whole), tuple(run_failures)


def check(
    fmu: Path,
    scenes: Sequence[Scene],
    folder: Path,
    progress: Progress = no_progress,
    *,
    tolerance: float = TOLERANCE,
    time_limit: float = TIME_LIMIT,
) -> Validation:
    """Compare an FMU with the golden results of scenes, by default of all that are recorded.

    Changed results are kept for `accept`; where that fails, it is a run failure. Raises
    HarnessError where nothing is recorded or a record cannot be read, FmuError for a file that is
    no FMU.
    """
    began = perf_counter()
    identity = identity_of(fmu)
    scenes = list({one.source: one for one in scenes or scenes_recorded(folder)}.values())
    for scene in scenes:
        if not (folder / scene.name).is_dir():
            known = [one.name for one in recorded_scenes(folder)]
            raise HarnessError(f"{folder}: {unknown_name('recorded scene', scene.name, known)}")
    golden = [read_recorded(folder / scene.name) for scene in scenes]
    measured, run_failures, not_applied = _measure(fmu, scenes, folder, progress, time_limit)
    compared: list[tuple[Check, Curves | None]] = []
    for scene, before in zip(scenes, golden, strict=True):
        shutil.rmtree(folder / CHANGED / scene.name, ignore_errors=True)
        now = measured.get(scene.source)
        if now is None:
            continue
        try:
            if before.provenance.get(SCENE_DIGEST) != scene_digest(scene):
                raise SceneError(
                    f"{scene.source}: no longer runs the recorded content of {scene.name}; record "
                    "it again with --replace"
                )
            found: list[tuple[Check, Curves | None]] = []
            for point in scene.points():
                at = key(point.at)
                golden_there = before.points.get(at, {})
                found += compare_golden(point, golden_there, now.points[at], tolerance)
            compared += found
            if not all(verdict.passed for verdict, _ in found):
                _keep_changed(folder / CHANGED, scene.name, now)
        except HarnessError as error:
            run_failures.append(RunFailure(scene.name, str(error), {}))
    return Validation(
        str(fmu),
        tuple(verdict for verdict, _ in compared),
        perf_counter() - began,
        tuple(run_failures),
        tuple(curves for _, curves in compared if curves is not None),
        not_applied=tuple(not_applied),
        identity=identity,
    )


def _keep_changed(folder: Path, name: str, now: Recorded) -> None:
    """Keep changed results for accept; HarnessError where that fails."""
    try:
        write_recorded(folder / name, now)
        if not (folder / ".gitignore").exists():
            write_text(folder / ".gitignore", "*\n")
    except HarnessError as error:
        raise HarnessError(f"the changes could not be kept for accept: {error}") from error


def accept(fmu: Path, folder: Path, names: Sequence[str]) -> tuple[str, ...]:
    """Accept the changes that the last check of this FMU found; return the names of the scenes.

    Without `names` that is every scene that has changed. Raises HarnessError for a name that is not
    among them, and where it was another FMU that was checked.
    """
    waiting = {path.name: path for path in recorded_scenes(folder / CHANGED)}
    for name in names:
        if name not in waiting:
            reason = f"{name}: nothing has changed since the last check, or there was none"
            if waiting:
                reason = unknown_name("changed scene", name, waiting)
            raise HarnessError(f"{folder}: {reason}")
    chosen = tuple(dict.fromkeys(names)) or tuple(waiting)
    if not chosen:
        return ()
    with open_fmu(fmu):
        digest = digest_of(fmu)
    for name in chosen:
        checked = read_recorded(waiting[name]).provenance
        if checked.get(FMU_DIGEST) != digest:
            raise HarnessError(
                f"{fmu}: not the FMU that was last checked, which was {checked.get('fmu')} with "
                f"SHA-256 {checked.get(FMU_DIGEST)}; check this one first"
            )
    for name in chosen:
        with explained(f"{folder / name}: cannot be written: ", HarnessError):
            replace_folder(waiting[name], folder / name)
    return chosen


def scenes_recorded(folder: Path) -> list[Scene]:
    """Return the scenes of everything recorded; HarnessError where that is nothing.

    A built-in one is found by its name, others where they were.
    """
    folders = recorded_scenes(folder)
    if not folders:
        raise HarnessError(
            f"{folder}: nothing is recorded here; `slider-resonator baseline record FMU --dir "
            f"{folder}` does so"
        )
    found = []
    for path in folders:
        file = read_recorded(path).provenance.get(SCENE_FILE, BUILT_IN)
        if file == BUILT_IN and path.name not in built_in_scenes():
            raise SceneError(
                f"{path}: recorded of a built-in scene that this version does not have; remove the "
                "folder, or name with --scene what to check"
            )
        name = path.name if file == BUILT_IN else f"{path.parent / file}#{path.name}"
        found.append(find_scene(name))
    return found


def _measure(
    fmu: Path, scenes: Sequence[Scene], folder: Path, progress: Progress, time_limit: float
) -> tuple[dict[str, Recorded], list[RunFailure], list[NotApplied]]:
    """Return the results by the source of the scene, what could not be run and what did not apply.

    A scene that fails at a point is left out. `folder` is where the results are to be kept.
    """
    with open_fmu(fmu):
        pass  # one that cannot be opened is no run failure, and nothing is made in `folder` for it
    make_folder(folder)
    points = {scene.source: scene.points() for scene in scenes}
    all_points = [point for some in points.values() for point in some]
    found: dict[str, dict[At, Golden]] = {source: {} for source in points}
    run_failures: list[RunFailure] = []
    not_applied: list[NotApplied] = []
    identity = identity_of(fmu)
    origins = {scene.source: provenance(identity, scene, folder) for scene in scenes}
    with closing(measure_points(fmu, all_points, measure_golden, time_limit)) as outcomes:
        for done, (point, outcome) in enumerate(outcomes):
            error = outcome.error
            if point is None:
                run_failures.append(RunFailure.of(fmu, None, error))
                continue
            name, at = point.scene.name, point.at
            progress(counted(name, done, len(all_points)), done / len(all_points))
            if isinstance(error, NotApplicable):
                not_applied.append(NotApplied(name, "the run", str(error), at))
            elif error is not None:
                run_failures.append(RunFailure.of(fmu, point, error))
            else:
                found[point.scene.source][key(at)] = outcome.value
    progress("", 1.0)
    whole = [source for source in points if len(found[source]) == len(points[source])]
    recorded = {source: Recorded(found[source], origins[source]) for source in whole}
    return recorded, run_failures, not_applied
