"""Recording golden results, checking an FMU against them, accepting what has changed."""

from __future__ import annotations

import shutil
from collections.abc import Sequence
from pathlib import Path
from time import perf_counter

from harness.atomic import replacing
from harness.baseline.judge import TOLERANCE, Compared, compared
from harness.baseline.measuring import Progress, measure_scenes
from harness.baseline.provenance import (
    BUILT_IN,
    FMU_DIGEST,
    SCENE_DIGEST,
    SCENE_FILE,
    file_digest,
    scene_digest,
)
from harness.baseline.store import (
    Recorded,
    read_recorded,
    recorded_scenes,
    replace_folder,
    write_recorded,
)
from harness.errors import HarnessError, SceneError
from harness.fmu import open_fmu
from harness.isolated_runs import TIME_LIMIT
from harness.names import unknown_name
from harness.scene import Scene, built_in_scenes, read_scene
from harness.targets import make_folder
from harness.validate import Curves, Trouble, Validation, curves_of

CHANGED = ".changed"
"""Folder beside the scenes with what the last check has found instead; git ignores it."""


def record(
    fmu: Path,
    files: Sequence[Path],
    folder: Path,
    progress: Progress = lambda scene, share: None,
    *,
    replace: bool = False,
    time_limit: float = TIME_LIMIT,
) -> tuple[tuple[str, ...], tuple[Trouble, ...]]:
    """Record scenes; return the names of those written and what could not be run.

    Raises HarnessError, before anything is run, where a scene is recorded already and `replace` is
    not set, where two scenes have one name, and for a folder that cannot be made; FmuError for a
    file that is no FMU.
    """
    scenes = [read_scene(file) for file in files]
    names = [scene.name for scene in scenes]
    twice = sorted({name for name in names if names.count(name) > 1})
    if twice:
        raise SceneError(f"several scenes are called {', '.join(twice)}; must be only one")
    there = [name for name in names if (folder / name).exists()]
    if there and not replace:
        raise HarnessError(
            f"{folder}: recorded already: {', '.join(there)}; check and accept show and take over "
            "what has changed, --replace records anew"
        )
    with open_fmu(fmu):
        pass  # nothing is made in `folder` for a file that is no FMU
    make_folder(folder)
    measured = measure_scenes(fmu, files, folder, progress, time_limit)
    for scene, file in zip(scenes, files, strict=True):
        if file in measured.scenes:
            write_recorded(folder / scene.name, measured.scenes[file])
            shutil.rmtree(folder / CHANGED / scene.name, ignore_errors=True)
    written = (s.name for s, file in zip(scenes, files, strict=True) if file in measured.scenes)
    return tuple(written), measured.troubles


def check(
    fmu: Path,
    files: Sequence[Path],
    folder: Path,
    progress: Progress = lambda scene, share: None,
    *,
    tolerance: float = TOLERANCE,
    time_limit: float = TIME_LIMIT,
) -> Validation:
    """Compare an FMU with what is recorded of scenes, of all that are without `files`.

    What has changed is kept for `accept`; where it cannot be, that is a trouble beside the
    verdicts. Raises HarnessError where nothing is recorded or a record cannot be read, FmuError
    for a file that is no FMU.
    """
    began = perf_counter()
    files = files or recorded_files(folder)
    scenes = {file: read_scene(file) for file in files}
    golden = {file: _recorded(folder, scene) for file, scene in scenes.items()}
    measured = measure_scenes(fmu, files, folder, progress, time_limit)
    verdicts: list[Compared] = []
    troubles = list(measured.troubles)
    for file, scene in scenes.items():
        shutil.rmtree(folder / CHANGED / scene.name, ignore_errors=True)
        if file not in measured.scenes:
            continue
        try:
            found = _compare(scene, golden[file], measured.scenes[file], tolerance)
        except SceneError as error:
            troubles.append(Trouble(scene.name, str(error), {}))
            continue
        verdicts += found
        if not all(verdict.check.passed for verdict in found):
            try:
                _keep(folder, scene.name, measured.scenes[file])
            except HarnessError as error:
                reason = f"what has changed could not be kept for accept: {error}"
                troubles.append(Trouble(scene.name, reason, {}))
    curves = (curves_of(one.check, one.measured, one.golden) for one in verdicts)
    return Validation(
        str(fmu),
        tuple(verdict.check for verdict in verdicts),
        perf_counter() - began,
        tuple(troubles),
        tuple(curve for curve in curves if isinstance(curve, Curves)),
    )


def accept(fmu: Path, folder: Path, names: Sequence[str] = ()) -> tuple[str, ...]:
    """Take over what the last check of this FMU has found changed; return the scenes' names.

    Without `names` that is every scene that has changed. Raises HarnessError for a name that is not
    among them, and where it was another FMU that was checked.
    """
    waiting = {path.name: path for path in recorded_scenes(folder / CHANGED)}
    for name in names:
        if name not in waiting:
            said = (
                unknown_name("changed scene", name, waiting)
                if waiting
                else (f"{name}: nothing has changed since the last check, or there was none")
            )
            raise HarnessError(f"{folder}: {said}")
    chosen = tuple(dict.fromkeys(names)) or tuple(waiting)
    if not chosen:
        return ()
    with open_fmu(fmu):
        digest = file_digest(fmu)
    for name in chosen:
        checked = read_recorded(waiting[name]).provenance
        if checked.get(FMU_DIGEST) != digest:
            raise HarnessError(
                f"{fmu}: not the FMU that was last checked, which was {checked.get('fmu')} with "
                f"SHA-256 {checked.get(FMU_DIGEST)}; check this one first"
            )
    for name in chosen:
        try:
            replace_folder(waiting[name], folder / name)
        except OSError as error:
            raise HarnessError(f"{folder / name}: cannot be written: {error.strerror}") from error
    return chosen


def recorded_files(folder: Path) -> list[Path]:
    """Return the scene files of everything recorded; HarnessError where that is nothing."""
    folders = recorded_scenes(folder)
    if not folders:
        raise HarnessError(f"{folder}: nothing is recorded here; record it first")
    return [_scene_file(path) for path in folders]


def _scene_file(path: Path) -> Path:
    """Return the scene's file: a built-in one by its name, others where they were."""
    file = read_recorded(path).provenance.get(SCENE_FILE, BUILT_IN)
    if file != BUILT_IN:
        return path.parent / file
    try:
        return built_in_scenes()[path.name]
    except KeyError:
        raise SceneError(
            f"{path}: recorded of a built-in scene that this version does not have; remove the "
            "folder, or name with --scene what to check"
        ) from None


def _recorded(folder: Path, scene: Scene) -> Recorded:
    path = folder / scene.name
    if not path.is_dir():
        known = [one.name for one in recorded_scenes(folder)]
        raise HarnessError(f"{folder}: {unknown_name('recorded scene', scene.name, known)}")
    return read_recorded(path)


def _compare(scene: Scene, golden: Recorded, now: Recorded, tolerance: float) -> list[Compared]:
    if golden.provenance.get(SCENE_DIGEST) != scene_digest(scene):
        raise SceneError(
            f"{scene.source}: does not run what was recorded of {scene.name}; record it again "
            "with --replace"
        )
    return [
        one
        for at, results in now.points.items()
        for one in compared(scene, dict(at), golden.points.get(at, {}), results, tolerance)
    ]


def _keep(folder: Path, name: str, now: Recorded) -> None:
    write_recorded(folder / CHANGED / name, now)
    ignored = folder / CHANGED / ".gitignore"
    if not ignored.exists():
        with replacing(ignored) as temporary:
            temporary.write_text("*\n", encoding="utf-8")
