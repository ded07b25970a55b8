"""An FMU in a process of its own, where it may crash or hang."""

import os
import pickle
import queue
import subprocess
import sys
import threading
from collections.abc import Callable
from contextlib import AbstractContextManager, ExitStack, suppress
from dataclasses import dataclass
from pathlib import Path
from time import monotonic
from typing import IO, Any

from slider_resonator.errors import FmuError
from slider_resonator.fmu.isolation.crash_report import crash_report
from slider_resonator.fmu.isolation.supervised import Supervised
from slider_resonator.output.files import temporary_folder
from slider_resonator.output.progress import Progress

PRINTED = "printed.txt"
"""File with what the FMU has printed."""
TRACEBACK = "traceback.txt"
"""File in the folder of the process with the calls that the FMU was in at its end."""
TIME_LIMIT = 120.0
"""Default time limit of a task, s; the slowest built-in scene takes a few."""
GRACE = 60.0
"""Seconds beyond the time limit after which a process that did not end itself is killed: before the
limit begins, a busy machine has to load Python and the modules of a task."""
POLL_INTERVAL = 0.5
"""Interval (s) at which the process is polled."""

Task = Callable[..., Any]
"""A picklable function, called as `task(instance)` in the process of the FMU; one that reports
progress, as `task(instance, progress=report)`, where `report(label, share)` sends what it does and
the share done."""
Request = tuple[Task, bool]
"""A task, and whether it reports progress; sent pickled, as is the answer."""
Done = tuple[str, float]
"""What the present task does, empty where that has no name, and its share done, 0 to 1."""


@dataclass(frozen=True)
class Outcome:
    """The `value` of a task or the `error` in its place; neither once the FMU is open."""

    value: Any = None
    error: Exception | None = None

    def result(self) -> Any:
        """Return the value, or raise the error."""
        if self.error is not None:
            raise self.error
        return self.value


class FmuDied(FmuError):
    """The process of the FMU crashed or exceeded a limit, and has been cleaned up.

    `over_limit` says that it was the limit of time, of memory or of processes.
    """

    def __init__(self, message: str, *, over_limit: bool = False) -> None:
        super().__init__(message)
        self.over_limit = over_limit


class IsolatedFmu(AbstractContextManager["IsolatedFmu"]):
    """A process that has instantiated an FMU and runs tasks on the instance, without one on None.

    Opening the FMU and each task may take `time_limit` (s). Raises FmuError when the FMU cannot be
    used, FmuDied when it ends the process. Use it in a `with` block, or call `close` or `kill`.
    One thread may use it; another one that sets `stop` ends it, with FmuDied, while it waits.
    """

    def __init__(
        self, fmu: Path | None, time_limit: float = TIME_LIMIT, stop: threading.Event | None = None
    ) -> None:
        self.time_limit = time_limit
        self._stop = stop or threading.Event()
        self._name = fmu.name if fmu else "it"
        self._resources = ExitStack()
        # Also for the unpacked FMU, which a process that has crashed leaves behind.
        self._folder = self._resources.enter_context(temporary_folder())
        self._log = self._folder / PRINTED
        try:
            # -P: the present folder must not be on the search path.
            child = (sys.executable, "-P", "-m", "slider_resonator.fmu.isolation.child")
            with self._log.open("wb") as log:
                self._process = Supervised(
                    [*child, str(fmu or ""), repr(self.time_limit), str(self._folder)],
                    self._folder,
                    os.environ.get("PYTHONPATH", ""),
                    stdin=subprocess.PIPE,
                    stdout=subprocess.PIPE,
                    stderr=log,
                )
            requests, answers = self._process.process.stdin, self._process.process.stdout
            assert requests is not None
            assert answers is not None
            self._resources.enter_context(suppress(OSError))  # it has closed its end of the pipe
            self._requests = self._resources.enter_context(requests)
            self._resources.callback(self._process.end)
            self._messages: queue.SimpleQueue[Done | Outcome | None] = queue.SimpleQueue()
            threading.Thread(target=_collect, args=(answers, self._messages), daemon=True).start()
            self._answer().result()
        except BaseException:
            self.kill()
            raise

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        """Free the FMU and end its process, at once after an error."""
        if error is None:
            self.close()
        else:
            self.kill()

    def run(self, task: Task, progress: Progress | None = None) -> Any:
        """Return the result of a task, or raise the HarnessError that it raised.

        With `progress` the task must take a keyword argument of that name. Raises FmuDied when the
        FMU crashed or exceeded the time limit. An interrupt, or an exception of `progress`, ends
        the process.
        """
        if self._requests.closed:
            raise FmuDied("the process of the FMU has been ended")
        request = pickle.dumps((task, progress is not None))
        try:
            # In a thread: it would wait for ever for a process that has stopped.
            threading.Thread(target=_send, args=(self._requests, request), daemon=True).start()
            answer = self._answer(progress)
        except BaseException:  # else the next task would get the answer to this one
            self.kill()
            raise
        return answer.result()

    def _answer(self, progress: Progress | None = None) -> Outcome:
        """Wait for the answer to a request; FmuDied as `run`.

        Does not rely on the end of the pipe, which a child may hold.
        """
        deadline = monotonic() + self.time_limit + GRACE
        while not self._stop.is_set():
            ended = self._process.wait(0.0)
            left = deadline - monotonic()
            try:
                message = self._messages.get(timeout=max(0.0, min(POLL_INTERVAL, left)))
            except queue.Empty:
                if ended or left <= 0.0:
                    raise self._died() from None
                continue
            if message is None:
                raise self._died()
            if isinstance(message, Outcome):
                return message
            if progress is not None:
                progress(*message)
        raise FmuDied("the process of the FMU has been stopped")

    def close(self) -> None:
        """Free the FMU and end its process; FmuDied when it crashes or hangs meanwhile."""
        if self._requests.closed:
            return
        try:
            self._requests.close()
            if not self._process.wait(self.time_limit + GRACE) or self._process.end().code != 0:
                raise self._died()
        except OSError as error:
            raise self._died() from error
        finally:
            self.kill()

    def kill(self) -> None:
        """End the process and all that it started, and remove its files."""
        self._resources.close()

    def _died(self) -> FmuDied:
        """Return the error for a process that has ended or must be ended, and clean up."""
        self._process.wait(POLL_INTERVAL)
        ending = self._process.end()
        printed, trace = _last(self._log), _last(self._folder / TRACEBACK)
        report, over = crash_report(self._name, printed, trace, ending, self.time_limit)
        self.kill()
        return FmuDied(report, over_limit=over)


def _send(requests: IO[bytes], content: bytes) -> None:
    with suppress(OSError, ValueError):  # a process that has ended is noticed by who waits for it
        requests.write(content)
        requests.flush()


def _last(file: Path) -> str:
    """Return the last part of a file, empty where there is none."""
    most = 2**16
    with suppress(OSError), file.open("rb") as opened:
        opened.seek(max(0, file.stat().st_size - most))
        return opened.read(most).decode("utf-8", errors="replace")
    return ""


def _collect(file: IO[bytes], received: "queue.SimpleQueue[Done | Outcome | None]") -> None:
    """Pass messages on, and None after the last or the first that is none."""
    with file:
        while True:
            try:
                message = pickle.load(file)
            except Exception:  # an FMU that writes into the pipe makes pickle raise anything
                break
            if not isinstance(message, tuple | Outcome):
                break
            received.put(message)
    received.put(None)
