"""Format numbers for tables and messages."""

from __future__ import annotations

NOISE = 1e-12
"""Magnitude in SI units below which a result is rounding error."""


def readable(value: float, digits: int) -> str:
    """Return a number with the given significant digits, noise and minus zero as 0."""
    return f"{0.0 if abs(value) < NOISE else value:.{digits}g}"


def number_of(count: int, noun: str) -> str:
    """Return a count with its noun, such as `1 check` and `2 checks`."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"
