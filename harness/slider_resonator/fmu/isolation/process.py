"""An FMU in a process of its own, seen from outside: it may crash or hang there."""

from __future__ import annotations

import os
import pickle
import queue
import subprocess
import sys
import tempfile
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

from slider_resonator.checks.compare import measure_all
from slider_resonator.checks.fmu_side import FmuSide
from slider_resonator.errors import FmuError
from slider_resonator.fmu.isolation.child import Answer, Request
from slider_resonator.fmu.isolation.crash_report import last_words
from slider_resonator.fmu.isolation.process_group import end_group
from slider_resonator.fmu.isolation.temporary_files import temporary_files_in

GRACE = 10.0
"""Seconds beyond its time limit after which a process that did not end itself is ended."""
START_UP = 60.0
"""Seconds in which Python and the harness are loaded, beside the FMU's own time limit."""


class FmuDied(FmuError):
    """The process of the FMU has crashed or did not answer in time: it is gone."""


class FmuProcess:
    """A process that has instantiated an FMU and measures in scenes.

    Raises FmuError when the FMU cannot be used, and FmuDied when it ends the process. Each call
    of the FMU may take `time_limit` (s). Must be ended with `close` or `kill`.
    """

    def __init__(self, fmu: Path, time_limit: float) -> None:
        self.time_limit = time_limit
        # Also for the unpacked FMU, which a process that has crashed does not tidy up.
        self._folder = tempfile.TemporaryDirectory(
            prefix="slider-resonator-", ignore_cleanup_errors=True
        )
        folder = self._folder.name
        self._log = Path(folder) / "said.txt"
        with self._log.open("wb") as log:
            self._process = subprocess.Popen(
                # -P: what lies in the user's folder is not what the harness imports.
                [
                    sys.executable,
                    "-P",
                    "-m",
                    "slider_resonator.fmu.isolation.child",
                    str(fmu),
                    repr(time_limit),
                ],
                env={
                    **os.environ,
                    **temporary_files_in(folder),
                    "PYTHONPATH": _search_path(),
                },
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=log,
                start_new_session=True,
            )
        self._answers: queue.SimpleQueue[Answer | None] = queue.SimpleQueue()
        assert self._process.stdout is not None
        reader = threading.Thread(
            target=_collect, args=(self._process.stdout, self._answers), daemon=True
        )
        reader.start()
        try:
            self._receive(START_UP)
        except BaseException:
            self.kill()
            raise

    def ask(
        self,
        scene: Path,
        at: Mapping[str, float],
        measure: Callable[[FmuSide], Any] = measure_all,
    ) -> None:
        """Have a function of a module measure in a scene with some values replaced; do not wait.

        By default that is what the scene expects, one measurement for each expectation.
        """
        assert self._process.stdin is not None
        try:
            pickle.dump(Request(scene, dict(at), measure), self._process.stdin)
            self._process.stdin.flush()
        except OSError as error:
            raise self._died() from error

    def answer(self) -> Any:
        """Wait for what was last asked for."""
        return self._receive(GRACE).result

    def close(self) -> None:
        """Let the FMU be freed and the process end; FmuDied when it does not get that far."""
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
        """End the process and what it started, if it still runs."""
        if self._process.poll() is None:
            end_group(self._process)
        for stream in (self._process.stdin, self._process.stdout):
            if stream is not None:
                with suppress(OSError):  # what cannot be flushed nobody reads any more
                    stream.close()
        self._folder.cleanup()

    def _receive(self, grace: float) -> Answer:
        try:
            answer = self._answers.get(timeout=self.time_limit + grace)
        except queue.Empty:
            raise self._died() from None
        if answer is None:
            raise self._died()
        if answer.error:
            raise FmuError(answer.error)
        return answer

    def _died(self) -> FmuDied:
        """Return the error for a process that has ended, or that has to be ended now."""
        try:
            code: int | None = self._process.wait(1.0)
        except subprocess.TimeoutExpired:
            code = None
            end_group(self._process)
        log = self._log.read_text(encoding="utf-8", errors="replace")
        return FmuDied(last_words(log, code, self.time_limit))


def _collect(file: IO[bytes], answers: queue.SimpleQueue[Answer | None]) -> None:
    """Pass answers on, and None where there are no more or what comes is none."""
    while True:
        try:
            answer = pickle.load(file)
        except Exception:  # an FMU that scribbles over the pipe makes pickle raise anything
            answers.put(None)
            return
        answers.put(answer if isinstance(answer, Answer) else None)


def _search_path() -> str:
    """Return PYTHONPATH with this package in front."""
    here = str(Path(__file__).resolve().parents[3])
    given = os.environ.get("PYTHONPATH")
    return os.pathsep.join([here, given] if given else [here])
