"""Run hand-written changes of the native FMU over the scenes."""

from __future__ import annotations

import time
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from contextlib import ExitStack, closing
from dataclasses import dataclass
from pathlib import Path

from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.checks.measure_points import measure_points
from slider_resonator.errors import FmuError
from slider_resonator.output.progress import Progress, counted, no_progress
from slider_resonator.output.temporary import temporary_folder
from slider_resonator.trials.mutants.attempt import Attempt, Bench
from slider_resonator.trials.mutants.native.changes import Change
from slider_resonator.trials.mutants.native.workshop import Workshop, read_native_sources
from slider_resonator.trials.mutants.points import scene_points
from slider_resonator.trials.mutants.rejecting_points import RejectingPoints
from slider_resonator.trials.mutants.trial import (
    ExpectedPoint,
    Observed,
    Rejection,
    judge,
    observe_expected,
)
from slider_resonator.trials.mutants.trial_client import trial_servers


@dataclass(frozen=True)
class ChangeVerdict:
    """Whether a change is rejected, by which scene and quantity, and why.

    A rejected one without a quantity could not be run.
    """

    change: Change
    rejected: bool
    scene: str = ""
    quantity: str = ""
    reason: str = ""

    @property
    def explained(self) -> bool:
        """Whether it is a fault that no scene can see, with the reason given beside it."""
        return bool(self.change.survives) and not self.rejected


@dataclass(frozen=True)
class NativeRun:
    """The verdicts on changes of an FMU; `wall_time` is in s."""

    fmu: str
    verdicts: tuple[ChangeVerdict, ...]
    wall_time: float

    @property
    def faults(self) -> tuple[ChangeVerdict, ...]:
        """The verdicts on faults."""
        return tuple(v for v in self.verdicts if not v.change.harmless)

    @property
    def survivors(self) -> tuple[ChangeVerdict, ...]:
        """The faults that pass every scene, those with a reason too."""
        return tuple(v for v in self.faults if not v.rejected)

    @property
    def false_alarms(self) -> tuple[ChangeVerdict, ...]:
        """The harmless variants that a scene rejects."""
        return tuple(v for v in self.verdicts if v.change.harmless and v.rejected)

    @property
    def rate(self) -> float | None:
        """Rejected faults as a share of those that a scene can see; None without any."""
        seen = [v for v in self.faults if not v.explained]
        return sum(v.rejected for v in seen) / len(seen) if seen else None


def run_changes(
    path: Path,
    changes: Sequence[Change],
    scene_files: Sequence[Path],
    *,
    jobs: int,
    time_limit: float,
    progress: Progress = no_progress,
) -> NativeRun:
    """Build the FMU at `path` with each change and try it on scenes, `jobs` at a time.

    Raises HarnessError when a change does not fit the sources or there is no compiler, FmuError
    when the FMU has no sources or is rejected unchanged, SceneError as `scene_points` does.
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
        bench = Bench(unchanged, points, costs, time_limit)
        servers = resources.enter_context(trial_servers(bench, jobs, folder))

        def verdict(number: int) -> ChangeVerdict:
            change = changes[number]
            library = workshop.library(change.name, {change.file: texts[number]})
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
            futures = [pool.submit(verdict, number) for number in range(len(changes))]
            try:
                for done, future in enumerate(as_completed(futures), start=1):
                    one = future.result()
                    word = "rejected" if one.rejected else "passes"
                    label = counted(f"{one.change.name} {word}", done - 1, len(changes))
                    progress(label, done / len(changes))
            finally:
                pool.shutdown(wait=True, cancel_futures=True)
    verdicts = tuple(future.result() for future in futures)
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
