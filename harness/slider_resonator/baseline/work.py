"""The three commands of a baseline: record golden results, check an FMU, accept changes."""

import hashlib
import os
import shutil
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

from slider_resonator.baseline.golden import (
    AGAINST,
    THE_RUN,
    TOLERANCE,
    At,
    Golden,
    Recorded,
    compare_golden,
    key,
    measure_golden,
    read_recorded,
    recorded_scenes,
    write_recorded,
)
from slider_resonator.checks.compare import Comparison
from slider_resonator.checks.validate import Judged, RunFailure, Validation, judge_points
from slider_resonator.errors import HarnessError, SceneError, unknown_name
from slider_resonator.fmu.isolation.process import TIME_LIMIT
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.provenance import digest_of, provenance_of, provenance_properties
from slider_resonator.output.files import make_folder, write_text
from slider_resonator.output.progress import Progress, no_progress
from slider_resonator.scenes.scene import Scene, ScenePoint
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
    ran, measured = _run(fmu, scenes, folder, lambda *_: (), progress, time_limit)
    run_failures = ran.run_failures
    if must_apply:
        run_failures += tuple(RunFailure(one.scene, one.reason, one.at) for one in ran.not_applied)
    for name, recorded in measured.items():
        write_recorded(folder / name, recorded)
        shutil.rmtree(folder / CHANGED / name, ignore_errors=True)
    return tuple(measured), run_failures


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
    scenes = list({one.source: one for one in scenes or scenes_recorded(folder)}.values())
    for scene in scenes:
        if not (folder / scene.name).is_dir():
            known = [one.name for one in recorded_scenes(folder)]
            raise HarnessError(f"{folder}: {unknown_name('recorded scene', scene.name, known)}")
    golden = {scene.name: read_recorded(folder / scene.name) for scene in scenes}
    digests = {scene.name: scene_digest(scene) for scene in scenes}

    def judge(point: ScenePoint, now: Golden) -> Iterator[Judged]:
        name = point.scene.name
        if golden[name].provenance.get(SCENE_DIGEST) != digests[name]:
            raise SceneError(
                f"{point.scene.source}: no longer runs the recorded content of {name}; record it "
                "again with --replace"
            )
        before = golden[name].points.get(key(point.at), {})
        return compare_golden(point, before, now, tolerance)

    ran, measured = _run(fmu, scenes, folder, judge, progress, time_limit)
    run_failures = [*ran.run_failures]
    for scene in scenes:
        shutil.rmtree(folder / CHANGED / scene.name, ignore_errors=True)
    for name in dict.fromkeys(one.scene for one in ran.failed if one.scene in measured):
        try:
            write_recorded(folder / CHANGED / name, measured[name])
            write_text(folder / CHANGED / ".gitignore", "*\n")
        except HarnessError as error:
            reason = f"the changes could not be kept for accept: {error}"
            run_failures.append(RunFailure(name, reason, {}))
    return replace(ran, run_failures=tuple(run_failures))


def accept(fmu: Path, folder: Path, names: Sequence[str]) -> tuple[str, ...]:
    """Accept the changes that the last check of this FMU found; return the names of the scenes.

    Without `names` that is every scene that has changed. Raises HarnessError for a name that is not
    among them, and where it was another FMU that was checked.
    """
    waiting = {path.name: path for path in recorded_scenes(folder / CHANGED)}
    for name in names:
        if name not in waiting:
            changed = f"(must be one of {', '.join(waiting)})" if waiting else "(no scene has)"
            raise HarnessError(f"{folder}: {name} has not changed in the last check {changed}")
    chosen = tuple(dict.fromkeys(names)) or tuple(waiting)
    if not chosen:
        return ()
    with open_fmu(fmu):
        digest = digest_of(fmu)
    results = {name: read_recorded(waiting[name]) for name in chosen}
    for recorded in results.values():
        checked = recorded.provenance
        if checked.get(FMU_DIGEST) != digest:
            raise HarnessError(
                f"{fmu}: not the FMU that was last checked, which was {checked.get('fmu')} with "
                f"SHA-256 {checked.get(FMU_DIGEST)}; check this one first"
            )
    for name, recorded in results.items():
        write_recorded(folder / name, recorded)
        shutil.rmtree(waiting[name], ignore_errors=True)
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


FMU_DIGEST = "fmu_sha256"
SCENE_DIGEST = "scene_sha256"
SCENE_FILE = "scene_file"
BUILT_IN = "built in"
"""In place of the file of a built-in scene."""


def scene_digest(scene: Scene) -> str:
    """Return the SHA-256 of a scene without its names and expectations.

    Of [run] it has what is set: a record stays valid when a version of the harness adds a key.
    """
    swept = scene.sweep and (scene.sweep.variable, scene.sweep.values)
    over_time = sorted({**scene.signals, **scene.tuning}.items())
    signals = [(name, s.times, s.values, s.hold) for name, s in over_time]
    several_ways = {"stop_time", "drive_periods", "step_size", "steps_per_period"}
    run = scene.run and scene.run.model_dump(exclude_defaults=True, exclude=several_ways)
    content = (sorted(scene.parameters.items()), signals, scene.stop_time, scene.step_size)
    return hashlib.sha256(repr((*content, swept, run)).encode()).hexdigest()


def _seen_from(folder: Path, scene: Scene) -> str:
    """Return the relative path of the file of a scene, with slashes on every platform."""
    file = scene.files[0]
    if built_in_scenes().get(scene.name) == file:
        return BUILT_IN
    try:
        return Path(os.path.relpath(file, folder)).as_posix()
    except ValueError:  # on another drive of Windows
        return file.resolve().as_posix()


def _run(
    fmu: Path,
    scenes: Sequence[Scene],
    folder: Path,
    judge: Callable[[ScenePoint, Golden], Iterable[Judged]],
    progress: Progress,
    time_limit: float,
) -> tuple[Validation, dict[str, Recorded]]:
    """Run scenes and judge the results at each point; return these, too, by the name of the scene.

    A scene that fails at a point has none. `folder` is where the results are to be kept.
    """
    with open_fmu(fmu):
        pass  # one that cannot be opened is no run failure, and nothing is made in `folder` for it
    make_folder(folder)
    found: dict[str, dict[At, Golden]] = {scene.name: {} for scene in scenes}
    provenance = provenance_of(fmu)
    origin = provenance_properties(provenance, provenance.fmus[0])
    # Recorded again on a day, the file is the same.
    origin |= {"fmu": fmu.name, "date": provenance.date.partition("T")[0]}

    def keep(point: ScenePoint, golden: Golden) -> Iterable[Judged]:
        if THE_RUN in golden:
            return [(Comparison(THE_RUN, AGAINST, ""), golden[THE_RUN], None)]
        found[point.scene.name][key(point.at)] = golden
        return judge(point, golden)

    points = [point for scene in scenes for point in scene.points()]
    ran = judge_points(fmu, points, measure_golden, keep, progress, time_limit)
    recorded = {}
    for scene in scenes:
        if len(found[scene.name]) == len(scene.points()):
            about = {SCENE_FILE: _seen_from(folder, scene), SCENE_DIGEST: scene_digest(scene)}
            about = {**origin, "scene": scene.name, **about}
            recorded[scene.name] = Recorded(found[scene.name], about)
    return ran, recorded
