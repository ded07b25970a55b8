"""Workers of a dask cluster, on any number of machines."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Sequence
from concurrent.futures import CancelledError as FutureCancelled
from concurrent.futures import Future
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from distributed import CancelledError, Client, KilledWorker, Worker, WorkerPlugin

from slider_resonator import __version__
from slider_resonator.errors import FmuError, HarnessError
from slider_resonator.sweeping.measures import Task
from slider_resonator.sweeping.worker import TIME_LIMIT, ChunkRunner, Point, Rows, failed_row

CONNECT_SECONDS = 30

_runners: dict[str, ChunkRunner] = {}
"""Digest of an FMU to its runner, on a worker."""


class FmuPlugin(WorkerPlugin):
    """Copy the FMU to every worker, also to one that joins later.

    Raises HarnessError on a worker with another version of this package: its rows could differ.
    """

    def __init__(
        self, digest: str, file_name: str, content: bytes, time_limit: float = TIME_LIMIT
    ) -> None:
        self.name = f"slider-resonator-{digest}"
        self.version = __version__
        self.digest = digest
        self.file_name = file_name
        self.content = content
        self.time_limit = time_limit

    def setup(self, worker: Worker) -> None:
        """Write the FMU on the worker's machine, in the folder that goes with the worker."""
        if __version__ != self.version:
            raise HarnessError(
                f"worker {worker.address} has slider-resonator {__version__}; must be "
                f"{self.version}, as where the sweep was started"
            )
        folder = tempfile.mkdtemp(prefix="fmu-", dir=worker.local_directory)
        fmu = Path(folder) / self.file_name
        fmu.write_bytes(self.content)
        _runners[self.digest] = ChunkRunner(fmu, self.time_limit)

    def teardown(self, worker: Worker) -> None:
        """End the FMU's processes on the worker."""
        if self.digest in _runners:
            _runners[self.digest].end()


def run_chunk(task: Task, digest: str, points: Sequence[Point]) -> Rows:
    """Return the rows of the points, on a worker; raises as `ChunkRunner.run` does."""
    if digest not in _runners:
        missing = "this worker has not been given the FMU"
        return [failed_row(task, number, missing) for number, _ in points], 0.0
    return _runners[digest].run(task, points)


class DaskWorkers:
    """The workers of a cluster, which itself recomputes the chunks of a dead worker."""

    losses: tuple[type[BaseException], ...] = (
        KilledWorker,
        CancelledError,
        FutureCancelled,
        FmuError,
    )
    attempts = 1  # the cluster has tried several by then

    def __init__(self, client: Client, address: str, task: Task, digest: str) -> None:
        self.client = client
        self.address = address
        self.task = task
        self.digest = digest
        self._executor: Any = client.get_executor(pure=False)  # type: ignore[no-untyped-call]

    @property
    def count(self) -> int:
        """How many threads the workers have at present."""
        with _naming_loss(self.address):
            threads: dict[str, int] = self.client.nthreads()  # type: ignore[no-untyped-call]
        return max(1, sum(threads.values()))

    def submit(self, points: Sequence[Point]) -> Future[Rows]:
        """Begin to compute a chunk."""
        with _naming_loss(self.address):
            future: Future[Rows] = self._executor.submit(run_chunk, self.task, self.digest, points)
            return future

    def replace_lost(self) -> None:
        """Check that the cluster is still there: it replaces its workers itself."""
        if self.client.status != "running":
            raise HarnessError(
                f"--dask {self.address}: the scheduler is lost; the same command continues the "
                "sweep"
            )


@contextmanager
def dask_workers(
    task: Task, digest: str, fmu: Path, address: str, time_limit: float
) -> Iterator[DaskWorkers]:
    """Yield the workers of the scheduler at `address`; HarnessError where none answers."""
    try:
        client = Client(  # type: ignore[no-untyped-call]
            address, timeout=CONNECT_SECONDS, set_as_default=False
        )
    except (OSError, ValueError) as error:
        raise HarnessError(f"--dask {address}: no scheduler answers: {error}") from error
    with client:
        plugin = FmuPlugin(digest, fmu.name, fmu.read_bytes(), time_limit)
        with _naming_loss(address):
            client.register_plugin(plugin)
        try:
            yield DaskWorkers(client, address, task, digest)
        finally:
            if client.status == "running":
                with suppress(OSError):
                    client.unregister_worker_plugin(plugin.name)  # type: ignore[no-untyped-call]


@contextmanager
def _naming_loss(address: str) -> Iterator[None]:
    """Turn the loss of the scheduler into a HarnessError that names it."""
    try:
        yield
    except OSError as error:  # also that of a closed connection and of a timeout
        raise HarnessError(
            f"--dask {address}: the scheduler is lost; the same command continues the sweep"
        ) from error
