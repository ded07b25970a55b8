"""Lines that fit the terminal: wrapped between words, indented under their own text."""

from __future__ import annotations

import os
import re
import sys

from slider_resonator.output.fitting_table import INDENT, words

_LABELLED = re.compile(r"\s*\S+(?: \S+)* {2,}(?=\S)")
"""The beginning of a line such as "cost     43 drive periods", up to its text."""


def terminal_width(*, err: bool = False) -> int | None:
    """Return the columns of the terminal that output or errors go to, None where it is none."""
    stream = sys.stderr if err else sys.stdout
    try:
        return os.get_terminal_size(stream.fileno()).columns if stream.isatty() else None
    except (AttributeError, OSError, ValueError):  # a closed stream, or one without a number
        return None


def fitting(text: str, width: int | None) -> str:
    """Return the text with lines of at most `width` columns, if it is given and words permit."""
    if width is None:
        return text
    return "\n".join(_wrapped(line, width) for line in text.splitlines())


def _wrapped(line: str, width: int) -> str:
    if len(line) <= width:
        return line
    label = _LABELLED.match(line)
    start = len(label[0]) if label else 0
    if not 0 < start <= width // 2:
        start = len(line) - len(line.lstrip()) + len(INDENT)
    return words(line, width, " " * start)
