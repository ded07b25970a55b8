"""Text that a command writes into a file of people's own, between two marks and nowhere else."""

from __future__ import annotations

from pathlib import Path

from harness.atomic import replacing
from harness.errors import HarnessError


def write_marked(path: Path, text: str, begin: str, end: str) -> None:
    """Write `text` to `path`; between the marks, and nowhere else, where the file has them.

    Raises HarnessError when the file cannot be read or written, or has only one of the marks.
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
    """Return what the file had with `text` between the marks."""
    if (
        before.count(begin) != 1
        or before.count(end) != 1
        or before.index(begin) > before.index(end)
    ):
        raise HarnessError(f"{path}: must have one {begin} and one {end} after it")
    head, _, rest = before.partition(begin)
    _, _, tail = rest.partition(end)
    return f"{head}{begin}\n{text}\n{end}{tail}"
