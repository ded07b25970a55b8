"""Run hand-written changes of the native FMU over the scenes."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from dataclasses import dataclass
from pathlib import Path

from slider_resonator.checks.measure_points import measure_points
from slider_resonator.checks.measuring import measure_all
from slider_resonator.errors import FmuError
from slider_resonator.output.console import counted
from slider_resonator.output.temporary import temporary_folder
from slider_resonator.trials.mutants.native.changes import Change
from slider_resonator.trials.mutants.native.workshop import Workshop, read_native_sources
from slider_resonator.trials.mutants.points import scene_points
from slider_resonator.trials.mutants.trial import ExpectedPoint, Rejection, trial

Progress = Callable[[str, float], None]


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
    progress: Progress = lambda label, share: None,
) -> NativeRun:
    """Build the FMU at `path` with each change and try it on scenes, `jobs` at a time.

    Raises HarnessError when a change does not fit the sources or there is no compiler, FmuError
    when the FMU has no sources or is rejected unchanged, SceneError as `scene_points` does.
    """
    began = time.perf_counter()
    sources = read_native_sources(path)
    texts = [change.applied(sources.files) for change in changes]
    with temporary_folder() as folder:
        workshop = Workshop(sources, folder)
        points = scene_points(scene_files, progress)
        progress("the unchanged FMU", 0.0)
        points = _by_cost(workshop.build("unchanged", {}), points, time_limit)

        def verdict(number: int) -> ChangeVerdict:
            change = changes[number]
            faulty = workshop.build(change.name, {change.file: texts[number]})
            try:
                seen = trial(faulty, points, time_limit)
            finally:
                faulty.unlink()
            if isinstance(seen, Rejection):
                return ChangeVerdict(change, True, seen.scene, seen.quantity, seen.reason)
            return ChangeVerdict(change, False)

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


def _by_cost(fmu: Path, points: Sequence[ExpectedPoint], time_limit: float) -> list[ExpectedPoint]:
    """Return the points, the cheapest first; FmuError unless the unchanged FMU passes all."""
    outcome = trial(fmu, points, time_limit)
    if isinstance(outcome, Rejection):
        where = f"scene {outcome.scene}: " if outcome.scene else ""
        raise FmuError(
            f"{fmu.name} is rejected before anything is changed: {where}{outcome.quantity}: "
            f"{outcome.reason}"
        )
    costs = []
    began = time.perf_counter()
    for _ in measure_points(fmu, points, measure_all, time_limit):
        costs.append(time.perf_counter() - began)
        began = time.perf_counter()
    order = sorted(range(len(points)), key=costs.__getitem__)
    return [points[i] for i in order]
