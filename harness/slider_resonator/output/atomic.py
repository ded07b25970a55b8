"""Files that are written in one piece."""

import csv
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from uuid import uuid4

from slider_resonator.errors import HarnessError


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


def write_csv(
    path: Path,
    header: Iterable[str],
    rows: Iterable[Iterable[Any]],
    *,
    quotes_text: bool = False,
) -> None:
    """Write a CSV file in one piece; HarnessError when it cannot be written."""
    with replacing(path) as temporary, temporary.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(
            file,
            quoting=csv.QUOTE_NONNUMERIC if quotes_text else csv.QUOTE_MINIMAL,
            lineterminator="\n",
        )
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
