"""Files of results: checked before anything runs, and written in one piece."""

import csv
import stat
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager, suppress
from pathlib import Path
from tempfile import TemporaryDirectory, TemporaryFile
from typing import Any
from uuid import uuid4

from slider_resonator.errors import HarnessError, explained

PICTURE_SUFFIXES = (".png", ".svg", ".pdf")


def writable(text: str, suffixes: Sequence[str] = ()) -> Path:
    """Return the path of a file that can be created, or replaced if it is a regular file.

    Raises HarnessError, also for a suffix other than one of `suffixes`, if any.
    """
    path = Path(text)
    mode = stat.S_IFREG  # of a new file
    with explained(f"{path}: cannot be written: ", HarnessError), suppress(FileNotFoundError):
        mode = path.lstat().st_mode
    if not stat.S_ISREG(mode):
        kind = "a directory" if stat.S_ISDIR(mode) else "a link, a pipe or a device"
        raise HarnessError(f"{path} is {kind}; must be a regular file or a new one")
    if suffixes and path.suffix.lower() not in suffixes:
        allowed = ", ".join(suffixes)
        raise HarnessError(f"{path}: the suffix is {path.suffix!r}; must be one of {allowed}")
    where = f"{path}: the folder {path.parent} cannot be written to: "
    with explained(where, HarnessError), TemporaryFile(dir=path.parent):
        pass  # permissions do not say it all
    return path


def make_folder(path: Path) -> None:
    """Create a folder for results if it does not exist; HarnessError when that is impossible."""
    with explained(f"{path}: cannot be made a folder: ", HarnessError):
        path.mkdir(parents=True, exist_ok=True)


def distinct(targets: Mapping[str, Path | None], sources: Mapping[str, Path]) -> None:
    """Raise HarnessError for a target, by its option's name, that is a source or another target."""
    taken = dict(sources)
    for option, path in targets.items():
        if path is None:
            continue
        for name, other in taken.items():
            # Linked files are the same, and not all need exist yet.
            there = path.exists() and other.exists()
            if path.samefile(other) if there else path.resolve() == other.resolve():
                raise HarnessError(f"{option} {path} is {name}; must be a file of its own")
        taken[f"the file of {option}"] = path


@contextmanager
def temporary_folder() -> Iterator[Path]:
    """Yield a new folder, in the folder for temporary files, for the length of the block."""
    with TemporaryDirectory(prefix="slider-resonator-", ignore_cleanup_errors=True) as folder:
        yield Path(folder)


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """Yield a temporary file beside `path`, with its suffix, that replaces it when the block ends.

    If the block fails, `path` stays unchanged. Raises HarnessError when it cannot be written.
    """
    temporary = path.with_name(f".{path.stem}-{uuid4().hex[:8]}{path.suffix}")
    try:
        temporary.touch(exist_ok=False)
        try:
            yield temporary
            temporary.replace(path)
        finally:
            temporary.unlink(missing_ok=True)
    except OSError as error:
        raise HarnessError(f"{path}: cannot be written: {error.strerror or error}") from error


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
            head, *rest = before.split(begin)
            parts = rest[0].split(end) if len(rest) == 1 and end not in head else []
            if len(parts) != 2:
                raise HarnessError(f"{path}: must have one {begin} and one {end} after it")
            content = f"{head}{begin}\n{text}\n{end}{parts[1]}"
    write_text(path, content)
