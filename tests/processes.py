"""Commands and Python code in processes of their own."""

import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
"""The checkout."""


def run_command(*command: object, **options: Any) -> subprocess.CompletedProcess[str]:
    """How a command ended and what it wrote; `options` are those of subprocess.run."""
    words = [str(word) for word in command]
    return subprocess.run(words, capture_output=True, text=True, check=False, **options)


def has_ended(pid: int, tries: int = 100) -> bool:
    """Whether a process is gone within seconds, or waits as a zombie for who started it."""
    for _ in range(tries):
        try:
            os.kill(pid, 0)
            if Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] == "Z":
                return True
        except (ProcessLookupError, FileNotFoundError):
            return True
        time.sleep(0.05)
    return False


def run_python(code: str, *arguments: object) -> str:
    """What code prints that can import the tests and must not fail."""
    done = run_command(sys.executable, "-X", "faulthandler", "-c", code, *arguments, cwd=ROOT)
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout
