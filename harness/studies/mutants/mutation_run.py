"""Try the mutants of an FMU on scenes and probes, in random order."""

from __future__ import annotations

import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from contextlib import ExitStack
from pathlib import Path
from random import Random

from slider_resonator.errors import FmuError
from slider_resonator.output.progress import Progress, counted, no_progress
from slider_resonator.output.temporary import temporary_folder
from studies.mutants.archive import PythonFmu
from studies.mutants.attempt import Bench
from studies.mutants.kept_verdicts import entry_of, open_journal, verdicts_on
from studies.mutants.mutant import Mutant
from studies.mutants.points import probe_points, scene_points
from studies.mutants.probes import probe_scenes
from studies.mutants.reach import reaches
from studies.mutants.staged_trials import StagedTrials
from studies.mutants.trial import ExpectedPoint, trial
from studies.mutants.trial_client import trial_servers
from studies.mutants.verdict import MutantVerdict, MutationRun

TIME_LIMIT = 30.0
"""Seconds for a mutant and a scene or point of a sweep; the slowest built-in one takes a few."""
PROBES = 39
BATCH = 2048
"""Mutants that get their verdicts before the next ones begin."""


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
    journal: Path | None = None,
    progress: Progress = no_progress,
) -> MutationRun:
    """Try mutants of the FMU at `path` on scenes, survivors on probes, `jobs` at a time.

    Verdicts that `journal` holds from an earlier run are taken from there. Raises FmuError when
    the unchanged FMU is rejected, SceneError as `scene_points` does, HarnessError as
    `Journal` does.
    """
    began = time.perf_counter()
    with ExitStack() as resources:
        folder = resources.enter_context(temporary_folder())
        points = scene_points(scene_files, progress)
        progress("the unchanged FMU", 0.0)
        _check_original(path, points, time_limit)
        probing = probe_points(path, probe_scenes(probes, seed), time_limit)
        every = [*points, *probing]
        kept_in = open_journal(journal or folder / "verdicts", path, every)
        resources.enter_context(kept_in)
        kept = verdicts_on(kept_in, mutants)
        reach = reaches(fmu, every, time_limit, jobs)
        bench = Bench(path.resolve(), every, [one.cost for one in reach], time_limit)
        pool = resources.enter_context(ThreadPoolExecutor(jobs))
        servers = resources.enter_context(trial_servers(bench, jobs, folder))
        resources.callback(pool.shutdown, wait=False, cancel_futures=True)
        trials = StagedTrials(fmu, bench, [one.places for one in reach], len(points), servers, pool)

        def keep(verdict: MutantVerdict) -> None:
            kept_in.add([entry_of(verdict)])
            kept[verdict.mutant.name] = verdict
            label = counted(f"{verdict.status}: {verdict.mutant.name}", len(kept) - 1, len(mutants))
            progress(label, len(kept) / len(mutants))

        # The finished batches of a run that is cut off are a random sample.
        in_random_order = Random(seed).sample(mutants, len(mutants))
        waiting = [mutant for mutant in in_random_order if mutant.name not in kept]
        for begin in range(0, len(waiting), BATCH):
            trials.judge(waiting[begin : begin + BATCH], keep)
        verdicts = tuple(kept[mutant.name] for mutant in mutants)
    return MutationRun(str(path), made, len(probing), verdicts, time.perf_counter() - began)


def _check_original(path: Path, points: Sequence[ExpectedPoint], time_limit: float) -> None:
    """Raise FmuError unless the unchanged FMU passes: else a rejection would prove nothing."""
    rejection = trial(path, points, time_limit)
    if rejection is not None:
        where = f"scene {rejection.scene}: " if rejection.scene else ""
        what = f"{rejection.quantity}: " if rejection.quantity else ""
        raise FmuError(
            f"{path} is rejected before anything is changed: {where}{what}{rejection.reason}"
        )
