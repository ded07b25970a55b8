"""Make foreign text, such as the log of an FMU, safe to show."""

from __future__ import annotations

import re

_CONTROL = re.compile("[\x00-\x08\x0b-\x1f\x7f-\x9f\u202a-\u202e\u2066-\u2069\ud800-\udfff]")
"""Terminal control characters, the direction marks of Unicode that reorder text, surrogates."""


def printable(text: str) -> str:
    """Return the text with U+FFFD for each control character but newline and tab."""
    return _CONTROL.sub("\ufffd", text.replace("\r\n", "\n"))
