"""Environment and temporary folder of the processes that the harness starts."""

import os
from pathlib import Path

PACKAGE_PATH = str(Path(__file__).resolve().parents[3])
"""The folder that this package is imported from."""
FOLDER = "SLIDER_RESONATOR_FOLDER"
"""The variable by which all processes of one temporary folder are known."""


def child_environment(folder: str, *search_path: str) -> dict[str, str]:
    """Return this process's environment with temporary files in `folder`.

    This package is importable there, and what is in the folders of `search_path`.
    """
    own = dict.fromkeys(("TMPDIR", "TEMP", "TMP", FOLDER), folder)
    search = os.pathsep.join([PACKAGE_PATH, *filter(None, search_path)])
    return {**os.environ, **own, "PYTHONPATH": search}


WORK = "work"
"""The folder that the FMU runs in."""
PRINTED = "printed.txt"
"""What the FMU has printed."""
TRACEBACK = "traceback.txt"
"""The calls that the FMU was in at its end."""
