"""Run hand-written changes of the native FMU over the scenes."""

from __future__ import annotations

import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import ExitStack, closing
from pathlib import Path

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measure_points import measure_points
from slider_resonator.errors import FmuError
from slider_resonator.output.progress import Progress, counted, no_progress
from slider_resonator.output.temporary import temporary_folder
from studies.mutants.attempt import Attempt, Bench
from studies.mutants.kept_verdicts import open_journal
from studies.mutants.native.change_verdict import ChangeVerdict, NativeRun
from studies.mutants.native.changes import Change
from studies.mutants.native.kept_changes import entry_of, verdicts_on
from studies.mutants.native.workshop import Workshop, read_native_sources
from studies.mutants.points import scene_points
from studies.mutants.rejecting_points import RejectingPoints
from studies.mutants.trial import (
    ExpectedPoint,
    Observed,
    Rejection,
    judge,
    observe_expected,
)
from studies.mutants.trial_client import trial_servers


def run_changes(
    path: Path,
    changes: Sequence[Change],
    scene_files: Sequence[Path],
    *,
    jobs: int,
    time_limit: float,
    journal: Path | None = None,
    progress: Progress = no_progress,
) -> NativeRun:
    """Build the FMU at `path` with each change and try it on scenes, `jobs` at a time.

    Verdicts that `journal` holds from an earlier run are taken from there. Raises HarnessError when
    a change does not fit the sources, there is no compiler, or as `Journal` does, FmuError when the
    FMU has no sources or is rejected unchanged, SceneError as `scene_points` does.
    """
    began = time.perf_counter()
    sources = read_native_sources(path)
    texts = [change.applied(sources.files) for change in changes]
    rejecting = RejectingPoints()
    with ExitStack() as resources:
        folder = resources.enter_context(temporary_folder())
        workshop = Workshop(sources, folder)
        points = scene_points(scene_files, progress)
        progress("the unchanged FMU", 0.0)
        unchanged = workshop.fmu(folder / "unchanged.fmu")
        costs = _costs(unchanged, points, time_limit)
        order = sorted(range(len(points)), key=costs.__getitem__)
        kept_in = open_journal(journal or folder / "verdicts", path, points)
        resources.enter_context(kept_in)
        kept = verdicts_on(kept_in, changes)
        bench = Bench(unchanged, points, costs, time_limit)
        servers = resources.enter_context(trial_servers(bench, jobs, folder))

        def verdict(change: Change, text: str) -> ChangeVerdict:
            library = workshop.library(change.name, {change.file: text})
            seen = servers.attempt(
                Attempt({workshop.binary: library}, rejecting.first(change.file, order))
            )
            if seen.rejection is None:
                return ChangeVerdict(change, False)
            if seen.at is not None:
                rejecting.add(change.file, seen.at)
            found = seen.rejection
            return ChangeVerdict(change, True, found.scene, found.quantity, found.reason)

        with ThreadPoolExecutor(jobs) as pool:
            futures = [
                pool.submit(verdict, change, text)
                for change, text in zip(changes, texts, strict=True)
                if change.name not in kept
            ]
            try:
                for future in as_completed(futures):
                    one = future.result()
                    kept_in.add([entry_of(one)])
                    kept[one.change.name] = one
                    word = "rejected" if one.rejected else "passes"
                    label = counted(f"{one.change.name} {word}", len(kept) - 1, len(changes))
                    progress(label, len(kept) / len(changes))
            finally:
                pool.shutdown(wait=True, cancel_futures=True)
    verdicts = tuple(kept[change.name] for change in changes)
    return NativeRun(str(path), verdicts, time.perf_counter() - began)


def _costs(fmu: Path, points: Sequence[ExpectedPoint], time_limit: float) -> list[float]:
    """Return the CPU time (s) of the FMU at each point; FmuError unless it passes all."""
    costs = []
    with closing(measure_points(fmu, points, _timed, time_limit)) as finished:
        for one in finished:
            rejection = None
            if one.error is not None or one.item is None:
                name = one.item.name if one.item is not None else ""
                rejection = Rejection(name, "", str(one.error))
            else:
                seen, cost = one.result
                costs.append(cost)
                rejection = judge(one.item, seen)
            if rejection is not None:
                where = f"scene {rejection.scene}: " if rejection.scene else ""
                raise FmuError(
                    f"{fmu.name} is rejected before anything is changed: {where}"
                    f"{rejection.quantity}: {rejection.reason}"
                )
    return costs


def _timed(side: FmuSide) -> tuple[Observed, float]:
    began = time.process_time()
    return observe_expected(side), time.process_time() - began
