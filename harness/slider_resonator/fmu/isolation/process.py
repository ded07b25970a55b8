"""An FMU in a process of its own, where it may crash or hang."""

from __future__ import annotations

import os
import pickle
import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from time import monotonic
from typing import IO, Any

from slider_resonator.errors import FmuError
from slider_resonator.fmu.isolation.child_environment import child_environment
from slider_resonator.fmu.isolation.crash_report import crash_report
from slider_resonator.fmu.isolation.messages import Failure, Message, Progress, Request, Result
from slider_resonator.fmu.isolation.process_group import end_group

TIME_LIMIT = 120.0
"""Default time limit of a task, s; the slowest built-in scene takes a few."""
GRACE = 60.0
"""Seconds beyond the time limit after which a process that did not end itself is killed: Python
and the modules of a task must be loaded in them, also on a busy machine."""
POLL_INTERVAL = 0.5
"""Interval (s) at which the process is polled."""

Task = Callable[..., Any]
"""A picklable function, called as `task(instance)` in the process of the FMU; one that reports
progress, as `task(instance, progress=report)`, where `report(share)` sends the share done."""


class FmuDied(FmuError):
    """The process of the FMU crashed or exceeded its time limit, and has been cleaned up."""


class IsolatedFmu:
    """A process that has instantiated an FMU and runs tasks on the instance.

    Opening the FMU and each task may take `time_limit` (s). Raises FmuError when the FMU cannot be
    used, FmuDied when it ends the process. Use it in a `with` block, or call `close` or `kill`.
    """

    def __init__(self, fmu: Path, time_limit: float = TIME_LIMIT) -> None:
        self.time_limit = time_limit
        self._killed = False
        # Also for the unpacked FMU, which a process that has crashed leaves behind.
        self._folder = tempfile.TemporaryDirectory(
            prefix="slider-resonator-", ignore_cleanup_errors=True
        )
        self._log = Path(self._folder.name) / "printed.txt"
        with self._log.open("wb") as log:
            self._process = subprocess.Popen(
                # -P: the present folder must not be on the search path.
                [
                    *(sys.executable, "-P", "-m", "slider_resonator.fmu.isolation.child"),
                    *(str(fmu), repr(time_limit)),
                ],
                env=child_environment(self._folder.name, os.environ.get("PYTHONPATH", "")),
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                start_new_session=True,
            )
        self._messages: queue.SimpleQueue[Message | None] = queue.SimpleQueue()
        self._reader = threading.Thread(
            target=_collect, args=(self._process.stdout, self._messages), daemon=True
        )
        self._reader.start()
        try:
            self.result()
        except BaseException:
            self.kill()
            raise

    def __enter__(self) -> IsolatedFmu:
        """Return the isolated FMU."""
        return self

    def __exit__(self, kind: object, error: BaseException | None, trace: object) -> None:
        """Free the FMU and end its process, at once after an error."""
        if error is None:
            self.close()
        else:
            self.kill()

    def run(self, task: Task, progress: Callable[[float], None] | None = None) -> Any:
        """Return the result of a task, or raise the HarnessError that it raised.

        With `progress` the task must take a keyword argument of that name. Raises FmuDied when the
        FMU crashed or exceeded the time limit.
        """
        self.submit(task, reports_progress=progress is not None)
        return self.result(progress)

    def submit(self, task: Task, *, reports_progress: bool = False) -> None:
        """Send a task without waiting; FmuDied when the process has ended already."""
        if self._killed:
            raise FmuDied("the process of the FMU has been ended")
        request = pickle.dumps(Request(task, reports_progress))
        assert self._process.stdin is not None
        try:
            self._process.stdin.write(request)
            self._process.stdin.flush()
        except OSError as error:
            raise self._died() from error

    def result(self, progress: Callable[[float], None] | None = None) -> Any:
        """Wait for the task that was submitted first, and return or raise as `run` does."""
        deadline = monotonic() + self.time_limit + GRACE
        while True:
            match self._receive(deadline):
                case Progress(share):
                    if progress is not None:
                        progress(share)
                case Failure(error):
                    raise error
                case Result(value):
                    return value

    def close(self) -> None:
        """Free the FMU and end its process; FmuDied when it crashes or hangs meanwhile."""
        if self._killed:
            return
        assert self._process.stdin is not None
        try:
            self._process.stdin.close()
            if self._process.wait(self.time_limit + GRACE) != 0:
                raise self._died()
        except (OSError, subprocess.TimeoutExpired) as error:
            raise self._died() from error
        finally:
            self.kill()

    def kill(self) -> None:
        """End the process and all that it started, and remove its files."""
        if self._killed:
            return
        self._killed = True
        end_group(self._process)
        assert self._process.stdin is not None
        with suppress(OSError):  # the process has closed its end of the pipe
            self._process.stdin.close()
        self._reader.join(POLL_INTERVAL)
        self._folder.cleanup()

    def _receive(self, deadline: float) -> Message:
        """Return the next message; does not rely on the end of the pipe, which a child may hold."""
        while True:
            ended = self._process.poll() is not None
            left = deadline - monotonic()
            try:
                message = self._messages.get(timeout=max(0.0, min(POLL_INTERVAL, left)))
            except queue.Empty:
                if ended or left <= 0.0:
                    raise self._died() from None
            else:
                if message is None:
                    raise self._died()
                return message

    def _died(self) -> FmuDied:
        """Return the error for a process that has ended or must be ended, and clean up."""
        try:
            code: int | None = self._process.wait(POLL_INTERVAL)
        except subprocess.TimeoutExpired:
            code = None
            end_group(self._process)
        log = self._log.read_text(encoding="utf-8", errors="replace")
        self.kill()
        return FmuDied(crash_report(log, code, self.time_limit))


def _collect(file: IO[bytes], messages: queue.SimpleQueue[Message | None]) -> None:
    """Pass messages on, and None after the last or the first that is none."""
    with file:
        while True:
            try:
                message = pickle.load(file)
            except Exception:  # an FMU that writes into the pipe makes pickle raise anything
                break
            if not isinstance(message, Message):
                break
            messages.put(message)
    messages.put(None)
