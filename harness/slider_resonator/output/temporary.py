"""Temporary folders, removed with their process or, after a crash, by the next process."""

import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

if sys.platform != "win32":
    import fcntl

PREFIX = "slider-resonator-"
OWNER = "owner.pid"
"""File in a folder that its process keeps locked: a lock ends with its process, however that is,
and is seen from other containers, where a process number means nothing."""
MIN_AGE = 30.0
"""Age (s) below which a folder may belong to a process that has not locked it yet."""


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """Yield a new folder, in the folder for temporary files, for the length of the block."""
    with suppress(OSError):
        for other in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
            with suppress(OSError):
                if _abandoned(other):
                    shutil.rmtree(other, ignore_errors=True)
    folder = Path(tempfile.mkdtemp(prefix=PREFIX))
    try:
        with (folder / OWNER).open("w", encoding="utf-8") as file:
            if sys.platform != "win32":
                fcntl.flock(file, fcntl.LOCK_EX)
            file.write(f"{os.getpid()}\n")
            file.flush()
            yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def _abandoned(folder: Path) -> bool:
    """Whether a folder is this user's, and its process has ended without removing it."""
    status = folder.lstat()
    if not folder.is_dir() or folder.is_symlink() or time.time() - status.st_mtime < MIN_AGE:
        return False
    owner = folder / OWNER
    if not owner.is_file():
        return False  # somebody else's, whatever it is called
    if sys.platform == "win32":
        owner.unlink()  # refused while its process has it open
        return True
    if status.st_uid != os.getuid():
        return False
    with owner.open(encoding="utf-8") as file:
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return False
    return True
