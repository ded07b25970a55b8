"""Write text between two marks of a file that is edited by hand."""

from __future__ import annotations

from pathlib import Path

from slider_resonator.errors import HarnessError
from slider_resonator.output.atomic import replacing


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
