"""Programs with foreign code, run so that they and all that they start end together."""

import json
import os
import socket
import subprocess
import sys
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from slider_resonator.fmu.limits import MEMORY, max_bytes

PACKAGE_PATH = str(Path(__file__).resolve().parents[3])
"""The folder that this package is imported from."""
MAX_ENDING = 90.0
"""Longest time (s) that ending a program may take; the supervisor gives up before."""


@dataclass(frozen=True)
class Ending:
    """How a program ended: exit code, or minus the number of the signal; None where it is unknown.

    `excess` says what it had where that was above a limit.
    """

    code: int | None = None
    excess: str = ""


class Supervised:
    """A running program in a session of its own, with `folder` for its temporary files.

    It can import this package, and what is on `search_path`; `streams` are stdin, stdout and stderr
    of `subprocess.Popen`. On Windows what the program has started is not ended; on other systems
    than Linux a child that has left the program's session is not.
    """

    def __init__(
        self, command: Sequence[str], folder: Path, search_path: str = "", **streams: Any
    ) -> None:
        self._ending: Ending | None = None
        self._control: socket.socket | None = None
        environment = {
            **os.environ,
            **dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)),
            "PYTHONPATH": os.pathsep.join(filter(None, [PACKAGE_PATH, search_path])),
        }
        if sys.platform == "win32":
            self.process = subprocess.Popen(command, env=environment, **streams)
            return
        self._control, theirs = socket.socketpair()
        with theirs:
            file = Path(__file__).with_name("supervisor.py")
            supervisor = [sys.executable, "-I", "-S", str(file), str(theirs.fileno())]
            self.process = subprocess.Popen(
                [*supervisor, str(max_bytes(MEMORY)), str(folder), *command],
                env=environment,
                pass_fds=[theirs.fileno()],
                start_new_session=True,
                **streams,
            )

    def wait(self, seconds: float) -> bool:
        """Wait for the end of the program and of all that it started; return whether it came."""
        with suppress(subprocess.TimeoutExpired):
            self.process.wait(seconds)
        return self.process.poll() is not None

    def end(self) -> Ending:
        """End the program and all that it started, if it still runs, and return how it ended."""
        if self._ending is not None:
            return self._ending
        ran = self.process.poll() is None
        if self._control is None:
            self.process.kill()
            code = self.process.wait()
            self._ending = Ending(None if ran else code)
            return self._ending
        with self._control as control:
            if ran:
                with suppress(OSError):
                    control.sendall(b"end")
            if not self.wait(MAX_ENDING):
                self.process.kill()
                self.process.wait()
            self._ending = Ending(self.process.returncode)
            with suppress(OSError, ValueError):  # it may have been killed before it reports
                self._ending = Ending(**json.loads(control.recv(4096)))
        return self._ending
