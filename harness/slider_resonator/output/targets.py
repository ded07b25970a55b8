"""Check output paths before anything runs."""

import stat
from collections.abc import Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryFile

from slider_resonator.errors import HarnessError

PICTURE_SUFFIXES = (".png", ".svg", ".pdf")


def writable(text: str, suffixes: Sequence[str] = ()) -> Path:
    """Return the path of a file that can be created, or replaced if it is a regular file.

    Raises HarnessError, also for a suffix other than one of `suffixes`, if any.
    """
    if not text:
        raise HarnessError("'' names no file; must be the name of a file")
    path = Path(text)
    try:
        mode = path.lstat().st_mode
    except FileNotFoundError:
        mode = stat.S_IFREG
    except OSError as error:
        raise HarnessError(f"{path}: cannot be written: {error.strerror}") from error
    if not stat.S_ISREG(mode):
        raise HarnessError(f"{path} is {_kind(mode)}; must be a regular file or a new one")
    if suffixes and path.suffix.lower() not in suffixes:
        allowed = ", ".join(suffixes)
        raise HarnessError(f"{path}: the suffix is {path.suffix!r}; must be one of {allowed}")
    if not path.parent.is_dir():
        raise HarnessError(f"{path}: there is no folder {path.parent}; create it first")
    try:
        with TemporaryFile(dir=path.parent):  # permissions do not say it all
            pass
    except OSError as error:
        reason = f"the folder {path.parent} cannot be written to: {error.strerror}"
        raise HarnessError(f"{path}: {reason}") from error
    return path


def make_folder(path: Path) -> None:
    """Create a folder for results if it does not exist; HarnessError when that is impossible."""
    try:
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise HarnessError(f"{path}: cannot be made a folder: {error.strerror}") from error


def distinct(targets: Mapping[str, Path | None], sources: Mapping[str, Path]) -> None:
    """Check that no target, by its option's name, is a source or another target.

    Raises HarnessError for one that is.
    """
    taken = dict(sources)
    for option, path in targets.items():
        if path is None:
            continue
        for name, other in taken.items():
            if _same(path, other):
                raise HarnessError(f"{option} {path} is {name}; must be a file of its own")
        taken[f"the file of {option}"] = path


def _same(one: Path, other: Path) -> bool:
    """Whether two paths are the same file, even linked or not yet created."""
    if one.exists() and other.exists():
        return one.samefile(other)
    return one.resolve() == other.resolve()


def _kind(mode: int) -> str:
    kinds = (
        (stat.S_ISDIR, "a directory"),
        (stat.S_ISLNK, "a symbolic link"),
        (stat.S_ISCHR, "a device"),
        (stat.S_ISBLK, "a device"),
        (stat.S_ISFIFO, "a pipe"),
        (stat.S_ISSOCK, "a socket"),
    )
    return next((words for test, words in kinds if test(mode)), "no regular file")
