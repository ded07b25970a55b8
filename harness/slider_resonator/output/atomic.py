"""Files that are written in one piece."""

from __future__ import annotations

import csv
import os
import re
import shutil
import sys
import tempfile
import time
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from slider_resonator.errors import HarnessError

MIN_AGE = 60.0
"""Age (s) below which a temporary file may be of a process on another machine."""


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a temporary file beside `path`, with its suffix, that replaces it when the block ends.

    If the block fails, `path` stays unchanged. Raises HarnessError when it cannot be written.
    """
    clear_abandoned(path.parent, path.stem)
    try:
        handle, name = tempfile.mkstemp(
            prefix=temporary_prefix(path.stem), suffix=path.suffix, dir=path.parent
        )
        os.close(handle)
        temporary = Path(name)
        try:
            yield temporary
            temporary.chmod(0o666 & ~_umask())
            os.replace(temporary, path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise HarnessError(f"{path}: cannot be written: {error.strerror or error}") from error


def temporary_prefix(name: str) -> str:
    """Return how the name of what will replace `name` begins: with the number of this process."""
    return f".{name}-{os.getpid()}-"


def clear_abandoned(folder: Path, name: str) -> None:
    """Remove what processes that were killed have left beside `name`."""
    if sys.platform == "win32":
        return
    temporary = re.compile(rf"\.{re.escape(name)}-(\d+)-")
    with suppress(OSError):
        for path in folder.iterdir():
            found = temporary.match(path.name)
            if found and not _runs(int(found[1])) and time.time() - _changed(path) > MIN_AGE:
                if path.is_dir() and not path.is_symlink():
                    shutil.rmtree(path, ignore_errors=True)
                else:
                    path.unlink(missing_ok=True)


def _runs(process: int) -> bool:
    try:
        os.kill(process, 0)
    except ProcessLookupError:
        return False
    except OSError:
        return True
    return True


def _changed(path: Path) -> float:
    """Return when a file, or a file in a folder, was last changed."""
    return max(one.lstat().st_mtime for one in (path, *path.glob("*")))


def write_text(path: Path, text: str) -> None:
    """Write a file in one piece; HarnessError when it cannot be written."""
    with replacing(path) as temporary:
        temporary.write_text(text, encoding="utf-8")


def write_csv(path: Path, header: Iterable[str], rows: Iterable[Iterable[Any]]) -> None:
    """Write a CSV file in one piece; HarnessError when it cannot be written."""
    with replacing(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(header)
        writer.writerows(rows)


def _umask() -> int:
    """Return the process's umask, which can only be read by setting it."""
    mask = os.umask(0)
    os.umask(mask)
    return mask


def write_marked(path: Path, text: str, begin: str, end: str) -> None:
    """Write `text` to `path`, only between the marks if the file has them.

    Raises HarnessError when the file cannot be read or written, or the marks are not one pair.
    """
    content = text + "\n"
    if path.exists():
        try:
            before = path.read_text(encoding="utf-8")
        except (OSError, UnicodeDecodeError) as error:
            raise HarnessError(f"{path}: cannot be read: {error}") from error
        if begin in before or end in before:
            content = _embedded(before, text, path, begin, end)
    with replacing(path) as temporary:
        temporary.write_text(content, encoding="utf-8")


def _embedded(before: str, text: str, path: Path, begin: str, end: str) -> str:
    """Return the text `before` with `text` between its marks."""
    if (
        before.count(begin) != 1
        or before.count(end) != 1
        or before.index(begin) > before.index(end)
    ):
        raise HarnessError(f"{path}: must have one {begin} and one {end} after it")
    head, _, rest = before.partition(begin)
    _, _, tail = rest.partition(end)
    return f"{head}{begin}\n{text}\n{end}{tail}"
