"""Format numbers for people."""

from __future__ import annotations

NOISE = 1e-12
"""Magnitude in SI units below which a number of such a device is rounding error."""


def readable(value: float, digits: int) -> str:
    """Return a number with the given significant digits, noise and minus zero as 0."""
    return f"{0.0 if abs(value) < NOISE else value:.{digits}g}"
