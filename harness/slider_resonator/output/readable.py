"""Numbers and foreign text, such as the log of an FMU, as they are shown."""

import re

NOISE = 1e-12
"""Magnitude in SI units below which a result is rounding error."""


def readable(value: float, digits: int) -> str:
    """Return a number with the given significant digits, noise and minus zero as 0."""
    return f"{0.0 if abs(value) < NOISE else value:.{digits}g}"


def number_of(count: float, noun: str) -> str:
    """Return a number with its noun, such as `1 check`, `2 checks` and `0.5 drive periods`."""
    said = f"{count:.10g}"
    return f"{said} {noun}" if said == "1" else f"{said} {noun}s"


_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
"""Terminal control characters, the direction marks of Unicode that reorder text, surrogates."""


def printable(text: str) -> str:
    """Return the text with U+FFFD for each control character but newline and tab."""
    return _CONTROL.sub("\ufffd", text.replace("\r\n", "\n"))


_WORKFLOW_COMMAND = re.compile(r"(?<!\S):(?=:)|##(?=\[)")
"""Where GitHub Actions may find a command in a log: `::name::` at the start of a line, which may be
a wrapped one, and `##[name]` anywhere."""


def escaped(text: str) -> str:
    """Return the text without control characters and commands to GitHub Actions."""
    return _WORKFLOW_COMMAND.sub(lambda found: f"{found[0]} ", printable(text))


def one_line(text: str) -> str:
    """Return foreign text, such as a path, for the middle of a line."""
    return escaped(" ".join(text.splitlines()))


def indented(text: str) -> str:
    """Return a message, escaped, whose further lines cannot pass for messages of their own."""
    return "\n  ".join(escaped(text).splitlines())
