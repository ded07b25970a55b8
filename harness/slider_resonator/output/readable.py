"""Numbers and foreign text, such as the log of an FMU, as they are shown."""

from __future__ import annotations

import re

NOISE = 1e-12
"""Magnitude in SI units below which a result is rounding error."""


def readable(value: float, digits: int) -> str:
    """Return a number with the given significant digits, noise and minus zero as 0."""
    return f"{0.0 if abs(value) < NOISE else value:.{digits}g}"


def number_of(count: int, noun: str) -> str:
    """Return a count with its noun, such as `1 check` and `2 checks`."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
"""Terminal control characters, the direction marks of Unicode that reorder text, surrogates."""


def printable(text: str) -> str:
    """Return the text with U+FFFD for each control character but newline and tab."""
    return _CONTROL.sub("\ufffd", text.replace("\r\n", "\n"))
