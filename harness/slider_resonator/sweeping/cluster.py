"""Workers of a dask cluster, on any number of machines."""

import tempfile
from collections.abc import Iterator
from concurrent.futures import CancelledError as FutureCancelled
from concurrent.futures import Future
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from distributed import CancelledError, Client, KilledWorker, Worker, WorkerPlugin, get_worker

from slider_resonator import __version__
from slider_resonator.errors import HarnessError
from slider_resonator.fmu.isolation.process import FmuDied, Outcome, Task
from slider_resonator.fmu.isolation.tasks import LocalProcesses

CONNECT_SECONDS = 30


class FmuPlugin(WorkerPlugin):
    """Copy the FMU to every worker, also to one that joins later, where `processes` run it.

    Raises HarnessError on a worker with another version of this package: its rows could differ.
    """

    def __init__(self, digest: str, file_name: str, content: bytes, time_limit: float) -> None:
        self.name = f"slider-resonator-{digest}"
        self.version = __version__
        self.processes: LocalProcesses | None = None
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
        self.processes = LocalProcesses(fmu, self.time_limit)

    def teardown(self, worker: Worker) -> None:
        """End the FMU's processes on the worker."""
        if self.processes is not None:
            self.processes.end()


def run_task(plugin_name: str, task: Task) -> Outcome:
    """Run a task of a sweep, on a worker."""
    plugin = get_worker().plugins.get(plugin_name)
    processes: LocalProcesses | None = getattr(plugin, "processes", None)
    if processes is None:  # also where the plugin refused to set up
        return Outcome(error=HarnessError("this worker has not been given the FMU"))
    return processes.run(task)


class DaskProcesses:
    """The workers of a cluster, which itself runs the tasks of a dead worker again."""

    def __init__(self, client: Client, plugin_name: str, count: int) -> None:
        self.count = count
        self._client = client
        self._plugin_name = plugin_name
        self._executor: Any = client.get_executor(pure=False)  # type: ignore[no-untyped-call]

    def submit(self, task: Task) -> Future[Outcome]:
        """Begin to run a task, or queue it."""
        future: Future[Outcome] = self._executor.submit(run_task, self._plugin_name, task)
        return future

    def outcome(self, future: Future[Outcome]) -> Outcome:
        """Wait for the outcome of a task; ConnectionError where the scheduler is lost."""
        try:
            return future.result()
        except (KilledWorker, CancelledError, FutureCancelled) as error:
            if self._client.status != "running":
                raise ConnectionError from error
            return Outcome(error=FmuDied("the worker process died at this point"))

    def end(self) -> None:
        """Take back what has not begun."""
        self._executor.shutdown(wait=False)


@contextmanager
def dask_processes(
    digest: str, fmu: Path, address: str, time_limit: float
) -> Iterator[DaskProcesses]:
    """Yield the workers of the scheduler at `address`.

    Raises HarnessError where none answers or it is lost.
    """
    try:
        client = Client(  # type: ignore[no-untyped-call]
            address, timeout=CONNECT_SECONDS, set_as_default=False
        )
    except (OSError, ValueError) as error:
        raise HarnessError(f"--dask {address}: no scheduler answers: {error}") from error
    with client:
        plugin = FmuPlugin(digest, fmu.name, fmu.read_bytes(), time_limit)
        try:
            client.register_plugin(plugin)
            threads: dict[str, int] = client.nthreads()  # type: ignore[no-untyped-call]
            processes = DaskProcesses(client, plugin.name, max(1, sum(threads.values())))
            try:
                yield processes
            finally:
                processes.end()
                if client.status == "running":
                    with suppress(OSError):
                        client.unregister_worker_plugin(plugin.name)  # type: ignore[no-untyped-call]
        except OSError as error:  # also that of a closed connection and of a timeout
            if client.status == "running":
                raise
            raise HarnessError(
                f"--dask {address}: the scheduler is lost; the same command continues the sweep"
            ) from error
