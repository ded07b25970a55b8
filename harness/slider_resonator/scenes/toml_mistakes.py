"""Explain errors of TOML itself: the line, its text and a remedy."""

from __future__ import annotations

import re
from collections.abc import Callable

_LINE = re.compile(r"\(at line (\d+), column \d+\)$")
_DECIMAL_COMMA = re.compile(r"=\s*([-+]?\d+),(\d+)\s*(#.*)?$")
_BARE_WORD = re.compile(r"=\s*[A-Za-z]")

MAX_SHOWN = 60
"""Characters of the line that are shown."""

_NAME_AND_VALUE = "must be key = value, or a heading such as [run]"


def toml_mistake(text: str, error: str) -> str:
    """Return where and what is wrong in `text`, and the remedy, for the error of `tomllib`."""
    lines = text.splitlines() or [""]
    found = _LINE.search(error)
    number = min(int(found[1]), len(lines)) if found else _unclosed(lines)
    line = lines[number - 1].strip()
    shown = line if len(line) <= MAX_SHOWN else f"{line[:MAX_SHOWN]}..."
    wrong = _LINE.sub("", error).removesuffix("(at end of document)").strip()
    return f"line {number}: {shown}: not TOML: {wrong}; {_remedy(error, line)}"


def _unclosed(lines: list[str]) -> int:
    """Return the number of the last line that opens more brackets than it closes."""
    opens = [n for n, line in enumerate(lines, 1) if _opened(line) > 0]
    return opens[-1] if opens else len(lines)


def _opened(line: str) -> int:
    return sum(line.count(c) for c in "[{") - sum(line.count(c) for c in "]}")


_REMEDIES: tuple[tuple[Callable[[str, str], bool], str], ...] = (
    (
        lambda error, _: "overwrite" in error or "twice" in error or "mutate" in error,
        "must be there once: delete one",
    ),
    (lambda error, _: "table declaration" in error, "close the bracket, as in [run]"),
    (lambda error, line: "Unclosed" in error or _opened(line) > 0, "close the bracket"),
    (
        lambda error, line: "Illegal character" in error or line.count('"') % 2 == 1,
        "close the quotes",
    ),
    (
        lambda error, line: "Invalid value" in error and bool(_BARE_WORD.search(line)),
        'a text needs quotes, as in "my_step"; true and false are small',
    ),
    (lambda error, _: "Invalid value" in error, "must be a number, a text in quotes or a list"),
)
"""Whether a remedy is the one for an error and its line."""


def _remedy(error: str, line: str) -> str:
    comma = _DECIMAL_COMMA.search(line)
    if comma:
        return f"a number has a decimal point: write {comma[1]}.{comma[2]}"
    return next((text for fits, text in _REMEDIES if fits(error, line)), _NAME_AND_VALUE)
