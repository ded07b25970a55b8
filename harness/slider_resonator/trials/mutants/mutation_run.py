"""Try mutants: find the scenes that execute them, and whether and why they are rejected."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

from slider_resonator.checks.verdict import place
from slider_resonator.errors import FmuError
from slider_resonator.output.console import counted
from slider_resonator.output.temporary import temporary_folder
from slider_resonator.trials.mutants.archive import PythonFmu
from slider_resonator.trials.mutants.mutant import Mutant
from slider_resonator.trials.mutants.points import probe_points, scene_points
from slider_resonator.trials.mutants.probes import probe_scenes
from slider_resonator.trials.mutants.reach import Reach, reaches
from slider_resonator.trials.mutants.trial import ExpectedPoint, Passed, Rejection, trial
from slider_resonator.trials.mutants.verdict import (
    EQUIVALENT,
    NOT_REACHED,
    REJECTED,
    SURVIVED,
    MutantVerdict,
    MutationRun,
)

TIME_LIMIT = 30.0
"""Seconds for a mutant and a scene or point of a sweep; the slowest built-in one takes a few."""
PROBES = 39

Progress = Callable[[str, float], None]


Reached = Sequence[tuple[ExpectedPoint, Reach]]
"""Points, the cheapest first, each with what it executes."""


@dataclass(frozen=True)
class _Bench:
    """The points, probes and limits that all mutants share."""

    fmu: PythonFmu
    scenes: Reached
    probes: Reached
    time_limit: float
    folder: Path


def run_mutants(
    path: Path,
    fmu: PythonFmu,
    mutants: Sequence[Mutant],
    scene_files: Sequence[Path],
    *,
    made: int,
    jobs: int,
    probes: int = PROBES,
    seed: int = 0,
    time_limit: float = TIME_LIMIT,
    progress: Progress = lambda label, share: None,
) -> MutationRun:
    """Try mutants of the FMU at `path` on scenes, survivors on probes, `jobs` at a time.

    Raises FmuError when the unchanged FMU is rejected, and SceneError as `scene_points` does.
    """
    began = time.perf_counter()
    with temporary_folder() as folder:
        points = scene_points(scene_files, progress)
        progress("the unchanged FMU", 0.0)
        _check_original(path, points, time_limit)
        probing = probe_points(path, probe_scenes(probes, seed), time_limit)
        reach = reaches(fmu, [*points, *probing], time_limit, jobs)
        bench = _Bench(
            fmu,
            _by_cost(points, reach[: len(points)]),
            _by_cost(probing, reach[len(points) :]),
            time_limit,
            folder,
        )
        verdicts = _all(bench, mutants, jobs, progress)
    return MutationRun(str(path), made, len(probing), verdicts, time.perf_counter() - began)


def _by_cost(points: Sequence[ExpectedPoint], reach: Sequence[Reach]) -> Reached:
    return sorted(zip(points, reach, strict=True), key=lambda pair: pair[1].cost)


def _through(reached: Reached, mutant: Mutant) -> list[ExpectedPoint]:
    """Return the points at which a mutant can make a difference."""
    place = (mutant.file, mutant.statement)
    return [point for point, reach in reached if place[1] is None or place in reach.places]


def _check_original(path: Path, points: Sequence[ExpectedPoint], time_limit: float) -> None:
    """Raise FmuError unless the unchanged FMU passes: else a rejection would prove nothing."""
    outcome = trial(path, points, time_limit)
    if isinstance(outcome, Rejection):
        where = f"scene {outcome.scene}: " if outcome.scene else ""
        what = f"{outcome.quantity}: " if outcome.quantity else ""
        raise FmuError(
            f"{path} is rejected before anything is changed: {where}{what}{outcome.reason}"
        )


def _all(
    bench: _Bench, mutants: Sequence[Mutant], jobs: int, progress: Progress
) -> tuple[MutantVerdict, ...]:
    with ThreadPoolExecutor(jobs) as pool:
        futures = [
            pool.submit(_verdict, bench, mutant, number) for number, mutant in enumerate(mutants)
        ]
        try:
            for done, future in enumerate(as_completed(futures), start=1):
                verdict = future.result()
                progress(
                    counted(f"{verdict.status}: {verdict.mutant.name}", done - 1, len(mutants)),
                    done / len(mutants),
                )
        finally:
            pool.shutdown(wait=False, cancel_futures=True)
    return tuple(future.result() for future in futures)


def _verdict(bench: _Bench, mutant: Mutant, number: int) -> MutantVerdict:
    scenes, probes = _through(bench.scenes, mutant), _through(bench.probes, mutant)
    if not scenes and not probes:
        return MutantVerdict(mutant, NOT_REACHED, "no scene and no probe executes the statement")
    faulty = bench.folder / f"mutant_{number}.fmu"
    bench.fmu.write(faulty, {mutant.path: mutant.new})
    try:
        seen = trial(faulty, scenes, bench.time_limit)
        if isinstance(seen, Rejection):
            return MutantVerdict(mutant, REJECTED, seen.reason, seen.scene, seen.quantity)
        if mutant.kind == "unit":
            return MutantVerdict(mutant, SURVIVED, "the interface is accepted with that unit")
        probed = trial(faulty, probes, bench.time_limit)
    finally:
        faulty.unlink()
    if isinstance(probed, Rejection):
        return MutantVerdict(mutant, SURVIVED, _survival(scenes, seen, probed))
    return MutantVerdict(mutant, EQUIVALENT, _equivalence(len(scenes), len(probes), seen, probed))


def _survival(scenes: Sequence[ExpectedPoint], seen: Passed, probed: Rejection) -> str:
    """Describe which probe differs, and what the scenes measured of it."""
    what = f"{probed.quantity}: " if probed.quantity else "cannot be run: "
    if not scenes:
        return f"no scene executes the statement, but {probed.scene} does: {what}{probed.reason}"
    return (
        f"in {probed.scene}: {what}{probed.reason}; the {len(scenes)} scenes that execute the "
        f"statement pass, {_nearest(seen)}"
    )


def _equivalence(scenes: int, probes: int, seen: Passed, probed: Passed) -> str:
    return (
        f"{scenes} scenes and {probes} probes execute the statement; nearest to its limit in a "
        f"scene is {_nearest(seen)}; in a probe {_nearest(probed)}"
    )


def _nearest(passed: Passed) -> str:
    check = passed.nearest
    if check is None or check.severity == 0.0:
        return "none: nothing differs"
    where = f"{check.scene}{place(check.at, ' at ')}"
    return f"{check.quantity} in {where} with {check.severity:.2g} of what is allowed"
