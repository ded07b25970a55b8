"""Number of drive periods after which drive and normal force repeat together."""

from fractions import Fraction
from functools import lru_cache

MAX_DENOMINATOR = 20
"""Largest number of drive periods that counts as a common period, by default."""

MAX_DEVIATION = 1e-12
"""Largest distance of a frequency ratio from p/q, relative to max(ratio, 1)."""


@lru_cache(maxsize=1024)  # sweeps ask for the same few again and again
def common_period(frequency_ratio: float, max_denominator: int = MAX_DENOMINATOR) -> int | None:
    """Return the q of frequency_ratio = p/q in lowest terms, None where it exceeds the maximum."""
    fraction = Fraction(frequency_ratio).limit_denominator(max_denominator)
    near = abs(float(fraction) - frequency_ratio) <= MAX_DEVIATION * max(1.0, abs(frequency_ratio))
    return fraction.denominator if near else None
