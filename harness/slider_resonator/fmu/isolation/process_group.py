"""Ending a process together with all that it has started."""

from __future__ import annotations

import os
import signal
import subprocess
import sys


def end_group(process: subprocess.Popen[bytes]) -> None:
    """Kill a process that leads a session of its own, and its children; wait for it."""
    if sys.platform == "win32":
        process.kill()
    else:
        os.killpg(process.pid, signal.SIGKILL)
    process.wait()
