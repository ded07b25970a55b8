"""Ending a process together with all that it has started."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from contextlib import suppress


def end_group(process: subprocess.Popen[bytes]) -> None:
    """Kill a process that leads a session of its own, and its children; wait for it.

    Also kills the children of a process that has just ended by itself.
    """
    if sys.platform == "win32":
        process.kill()
    else:
        with suppress(ProcessLookupError, PermissionError):  # the group has no process left
            os.killpg(process.pid, signal.SIGKILL)
    process.wait()
