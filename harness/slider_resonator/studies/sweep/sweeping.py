"""A sweep from grid file to table, going on where an earlier attempt ended."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import asdict, dataclass
from importlib.util import find_spec
from pathlib import Path

from slider_resonator import __version__
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.opening import open_fmu
from slider_resonator.studies.sweep.grid import Sweep
from slider_resonator.studies.sweep.journal import Journal, journal_path
from slider_resonator.studies.sweep.local import local_workers
from slider_resonator.studies.sweep.running import Workers, run_points
from slider_resonator.studies.sweep.table import Columns, check_writer, table_columns, write_table
from slider_resonator.studies.sweep.worker import Row


@dataclass(frozen=True)
class SweepResult:
    """A finished sweep: `found` points were finished before it began, `failed` have an error."""

    points: int
    found: int
    failed: int
    first_error: str | None
    columns: Columns


def run_sweep(
    sweep: Sweep,
    fmu: Path,
    out: Path,
    *,
    workers: int,
    dask: str | None = None,
    restart: bool = False,
    progress: Callable[[str, float], None] = lambda label, share: None,
) -> SweepResult:
    """Compute the points that the journal beside `out` does not hold, and write the table.

    `workers` is the number of processes here, unless `dask` is the address of a scheduler.
    Raises HarnessError where the sweep cannot be run; what is finished then stays in the journal.
    """
    check_writer(out)
    with open_fmu(fmu):
        pass  # the file is checked once, not at every point
    fmu_digest = hashlib.sha256(fmu.read_bytes()).hexdigest()
    with Journal(journal_path(out), _digest(sweep, fmu_digest), restart=restart) as journal:
        found = len(journal.rows)
        left = [(n, point) for n, point in enumerate(sweep.points) if n not in journal.rows]

        def keep(rows: Sequence[Row]) -> None:
            journal.add(rows)
            done = len(journal.rows)
            progress(f"point {done} of {len(sweep.points)}", done / len(sweep.points))

        keep([])
        if left:
            with _workers(sweep, fmu_digest, fmu, min(workers, len(left)), dask) as at_work:
                run_points(at_work, sweep.task, left, keep)
        columns = table_columns(sweep.task, sweep.points, journal.rows)
        write_table(out, sweep.task, columns)
        journal.remove()
    errors = [error for error in columns["error"] if error is not None]
    return SweepResult(
        len(sweep.points), found, len(errors), errors[0] if errors else None, columns
    )


def _workers(
    sweep: Sweep, digest: str, fmu: Path, count: int, dask: str | None
) -> AbstractContextManager[Workers]:
    if dask is None:
        return local_workers(sweep.task, fmu, count)
    if find_spec("distributed") is None:
        raise HarnessError("--dask needs dask.distributed: pip install 'slider-resonator[cluster]'")
    from slider_resonator.studies.sweep.cluster import dask_workers

    return dask_workers(sweep.task, digest, fmu, dask)


def _digest(sweep: Sweep, fmu_digest: str) -> str:
    """Return what a row of a journal depends on, as a digest."""
    content = [__version__, fmu_digest, asdict(sweep.task), sweep.points]
    return hashlib.sha256(json.dumps(content).encode()).hexdigest()
