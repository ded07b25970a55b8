"""Numbers for people."""

from __future__ import annotations

NOISE = 1e-12
"""What is smaller, in SI units, is rounding: no quantity of such a device is meant by it."""


def readable(value: float, digits: int) -> str:
    """Return a number with so many significant digits, noise and minus zero as 0."""
    return f"{0.0 if abs(value) < NOISE else value:.{digits}g}"
