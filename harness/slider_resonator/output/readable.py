"""Format numbers for tables and messages."""

from __future__ import annotations

NOISE = 1e-12
"""Magnitude in SI units below which a result is rounding error."""


def readable(value: float, digits: int) -> str:
    """Return a number with the given significant digits, noise and minus zero as 0."""
    return f"{0.0 if abs(value) < NOISE else value:.{digits}g}"
