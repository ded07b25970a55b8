"""A sweep from grid file to table, going on where an earlier attempt ended.

The table is Parquet or CSV, the same bytes for the same rows. A journal beside it keeps the
finished points until it is written.
"""

import hashlib
import json
from collections import Counter, deque
from collections.abc import Callable, Iterable, Sequence
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass
from functools import partial
from importlib.util import find_spec
from itertools import islice, starmap
from pathlib import Path
from typing import TYPE_CHECKING, Any

from slider_resonator import __version__
from slider_resonator.device.interface import VARIABLES
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.process import TIME_LIMIT, FmuDied
from slider_resonator.fmu.isolation.tasks import QUEUED, LocalProcesses, Processes, run_all_tasks
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.fmu.provenance import digest_of
from slider_resonator.output.console import noting_on_interrupt
from slider_resonator.output.files import replacing, writable, write_csv
from slider_resonator.output.journal import Journal
from slider_resonator.output.progress import Progress, no_progress
from slider_resonator.output.readable import number_of
from slider_resonator.output.shown import Drawable, Shown, Tabular
from slider_resonator.steady.searches import SEARCHES
from slider_resonator.sweeping.grid import Sweep
from slider_resonator.sweeping.measures import (
    Columns,
    Point,
    Proved,
    Row,
    Task,
    failed_row,
    measure_point,
    prove_points,
    unit,
)

if TYPE_CHECKING:
    from matplotlib.figure import Figure


SUFFIXES = (".parquet", ".csv")
BATCH = 100
"""Points whose predictions are proved in one task."""
ATTEMPTS = 3
"""Processes that may die at a point before it counts as the cause."""

Keep = Callable[[Sequence[Row]], None]
"""Called with rows as they come, in any order."""


@dataclass(frozen=True, repr=False)
class SweepResult(Shown, Tabular, Drawable):
    """A finished sweep: `found` points were finished before it began, `failed` have an error.

    `unanswered` have no error, but a measure that does not exist there, such as a steady velocity.
    """

    points: int
    found: int
    failed: int
    unanswered: int
    first_error: str | None
    columns: Columns
    sweep: Sweep

    def table(self) -> Columns:
        """Return the columns of the table."""
        return self.columns

    def figure(self) -> "Figure":
        """Draw every measure over what was varied: lines or a map.

        Raises HarnessError where more than two variables were varied.
        """
        # Imported here: drawing takes longer to load than many sweeps to run.
        from slider_resonator.sweeping.picture import check_picture, sweep_figure

        check_picture(self.sweep, "plot()")
        return sweep_figure(self.sweep, self.columns)

    def sentences(self) -> list[str]:
        """Return how many points there are, and what became of them."""
        lines = [f"points     {self.points}"]
        if self.found:
            lines.append(f"found      {self.found} of them finished before")
        if self.unanswered:
            statuses: Counter[str] = Counter()
            for name in SEARCHES.keys() & self.sweep.task.measures:
                pairs = zip(self.columns[name], self.columns[f"{name}_status"], strict=True)
                statuses.update(status for value, status in pairs if value is None and status)
            reasons = ", ".join(f"{one} ({count})" for one, count in statuses.most_common())
            points = number_of(self.unanswered, "point")
            lines.append(f"no answer  to a measure at {points}: {reasons}")
        if self.failed:
            points = number_of(self.failed, "point")
            lines.append(f"failed     {points}; the first error: {self.first_error}")
        return lines

    def describe(self) -> list[str]:
        """Return what was varied, what became of the points, and the range of each measure."""
        names = self.sweep.task.names
        lines = [f"over       {', '.join(names)}", *self.sentences()]
        units = {name: VARIABLES[name].unit for name in names}
        units |= {measure: unit(measure) for measure in self.sweep.task.measures}
        for name, one in units.items():
            numbers = [value for value in self.columns[name] if value is not None]
            if numbers:
                span = f"{name:<16} {min(numbers):.6g} to {max(numbers):.6g}"
                lines.append(span if one == "1" else f"{span} {one}")
        return lines


def run_sweep(
    sweep: Sweep,
    fmu: Path,
    out: Path,
    *,
    workers: int,
    dask: str | None = None,
    restart: bool = False,
    overwrite: bool = False,
    time_limit: float = TIME_LIMIT,
    progress: Progress = no_progress,
) -> SweepResult:
    """Compute the points that the journal beside `out` does not hold, and write the table.

    `workers` is the number of processes here, unless `dask` is the address of a scheduler. A point
    that takes longer than `time_limit` (s) fails. Raises HarnessError where the sweep cannot be run
    or, without `overwrite`, `out` exists; finished points stay in the journal.
    """
    check_writer(out)
    if dask is not None and find_spec("distributed") is None:
        raise HarnessError("--dask needs dask.distributed: pip install 'slider-resonator[cluster]'")
    if out.exists() and not overwrite:
        raise HarnessError(
            f"{out}: exists; must be a new file, or allow it to be overwritten (--overwrite, "
            "overwrite=True)"
        )
    with open_fmu(fmu):
        pass  # the file is checked once, not at every point
    fmu_digest = digest_of(fmu)
    # All that the rows of a journal depend on.
    work = [__version__, fmu_digest, asdict(sweep.task), sweep.points]
    content = json.dumps(work, default=dict)
    digest = hashlib.sha256(content.encode()).hexdigest()
    remedy = "move the file away, or discard it (--restart, restart=True)"
    with Journal(
        out.with_name(f"{out.name}.journal"), "sweep", digest, remedy, restart=restart
    ) as journal:
        rows: dict[int, Row] = {
            number: (number, cells, error)
            for kept in journal.entries
            for number, cells, error in kept
        }
        found = len(rows)

        def keep(new: Sequence[Row]) -> None:
            if new:
                journal.add([new])
            rows.update((row[0], row) for row in new)
            progress(f"point {len(rows)} of {len(sweep.points)}", len(rows) / len(sweep.points))

        def note() -> str:
            points = f"{len(rows)} of {len(sweep.points)} points"
            return f"{points} are kept in {journal.path}; the same command goes on from there"

        keep([])
        left = [(n, point) for n, point in enumerate(sweep.points) if n not in rows]
        if left:
            processes: AbstractContextManager[Processes]
            if dask is None:
                processes = LocalProcesses(fmu.resolve(), time_limit, min(workers, len(left)))
            else:
                from slider_resonator.sweeping.cluster import dask_processes

                processes = dask_processes(fmu_digest, fmu, dask, time_limit)
            with noting_on_interrupt(note), processes as at_work:
                run_points(at_work, sweep.task, left, keep)
        columns = table_columns(sweep.task, sweep.points, map(rows.__getitem__, sorted(rows)))
        write_table(out, sweep.task, columns)
        journal.remove()
    errors = [error for error in columns["error"] if error is not None]
    measured = zip(*(columns[name] for name in ("error", *sweep.task.measures)), strict=True)
    return SweepResult(
        points=len(sweep.points),
        found=found,
        failed=len(errors),
        unanswered=sum(error is None and None in values for error, *values in measured),
        first_error=errors[0] if errors else None,
        columns=columns,
        sweep=sweep,
    )


def run_points(processes: Processes, task: Task, points: Sequence[Point], keep: Keep) -> None:
    """Compute all points.

    What the FMU predicts is proved in batches; what remains of one is measured point by point
    before further batches. A point that exceeds a limit, or at which processes keep dying, has an
    error as its row. Raises FmuError when the FMU cannot be used.
    """

    def measuring(point: Point, proved: Proved) -> partial[Any]:
        return partial(measure_point, task=task, point=point, proved=proved)

    first = [] if any(name in SEARCHES for name in task.measures) else points
    starts = range(0, 0 if first else len(points), BATCH)
    batches = (partial(prove_points, task=task, points=points[n : n + BATCH]) for n in starts)
    begun = [*(measuring(point, {}) for point in first), *islice(batches, QUEUED * processes.count)]
    queue = deque(((work, 1), work) for work in begun)
    for (work, attempt), outcome in run_all_tasks(processes, queue):
        error = outcome.error
        if isinstance(error, FmuDied) and not error.over_limit and attempt < ATTEMPTS:
            queue.append(((work, attempt + 1), work))  # others may be at fault
        elif "point" in work.keywords:
            number, _ = work.keywords["point"]
            keep([outcome.value if error is None else failed_row(task, number, str(error))])
        else:
            batch = work.keywords["points"]
            found = outcome.value if error is None else [{}] * len(batch)
            keep([one for one in found if isinstance(one, tuple)])
            left = [pair for pair in zip(batch, found, strict=True) if isinstance(pair[1], dict)]
            queue.extendleft(((one, 1), one) for one in starmap(measuring, reversed(left)))
            queue.extend(((one, 1), one) for one in islice(batches, 1))


def check_writer(path: Path) -> None:
    """Raise HarnessError where the table could not be written: its path, or a package it needs."""
    writable(str(path), SUFFIXES)
    if path.suffix.lower() == ".parquet" and find_spec("pyarrow") is None:
        raise HarnessError(
            f"{path}: Parquet needs pyarrow: pip install 'slider-resonator[parquet]'; "
            "a file called .csv does not"
        )


def table_columns(task: Task, points: Sequence[tuple[float, ...]], rows: Iterable[Row]) -> Columns:
    """Return the columns of the table that these rows make."""
    lines = ((number, *points[number], *cells, error) for number, cells, error in rows)
    columns = zip(task.columns, zip(*lines, strict=True), strict=True)
    return {name: [*map(int, one)] if kind is int else [*one] for (name, kind), one in columns}


def write_table(path: Path, task: Task, columns: Columns) -> None:
    """Write the table; the suffix chooses the format. Numbers come back to the last digit."""
    if path.suffix.lower() == ".csv":
        write_csv(path, columns, zip(*columns.values(), strict=True))
        return
    import pyarrow as pa
    from pyarrow import parquet

    types = {int: pa.int64(), float: pa.float64(), str: pa.string()}
    schema = pa.schema([(name, types[kind]) for name, kind in task.columns])
    with replacing(path) as temporary:
        parquet.write_table(pa.table(dict(columns), schema=schema), temporary)
