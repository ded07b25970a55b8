"""Commands and Python code in processes of their own."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
"""The checkout."""


def run_command(*command: object, **options: Any) -> subprocess.CompletedProcess[str]:
    """How a command ended and what it wrote; `options` are those of subprocess.run."""
    words = [str(word) for word in command]
    return subprocess.run(words, capture_output=True, text=True, check=False, **options)


def run_python(code: str, *arguments: object) -> str:
    """What code prints that can import the tests and must not fail."""
    done = run_command(sys.executable, "-X", "faulthandler", "-c", code, *arguments, cwd=ROOT)
    assert done.returncode == 0, done.stderr[-2000:]
    return done.stdout
