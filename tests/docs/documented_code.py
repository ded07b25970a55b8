"""Code of the documentation, run in a folder of its own."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path


def output_of(code: str, file: Path, folder: Path) -> tuple[list[str], str]:
    """Run code beside `dist` with a file; return the lines printed and the one in its comment."""
    (folder / "dist").mkdir()
    shutil.copy(file, folder / "dist")
    done = subprocess.run(
        [sys.executable, "-c", code],
        cwd=folder,
        env={**os.environ, "LD_LIBRARY_PATH": f"{sys.prefix}/lib"},  # ecos needs the one of tbb
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stderr
    (expected,) = re.findall(r"^ *# (.*)$", code, re.MULTILINE)
    return done.stdout.splitlines(), expected
