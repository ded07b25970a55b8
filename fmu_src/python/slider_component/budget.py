"""The work and the time of one communication step."""

from dataclasses import dataclass
from math import floor, log10

from . import refusal_texts
from .constants import MAX_STEP_SEGMENTS, PYTHON_SLOWDOWN
from .values import Refusal

MAX_SEGMENTS = MAX_STEP_SEGMENTS // PYTHON_SLOWDOWN
"""Segments of motion in one communication step up to which its work is accepted."""


@dataclass(slots=True)
class Budget:
    """The segments that are `left` to a step of `step_size` [s]; all its parts draw from them."""

    step_size: float
    left: int = MAX_SEGMENTS

    def refusal(self, reached: float) -> Refusal:
        """Return the refusal of more segments; a step up to `reached` [s] takes less."""
        return too_much_work(self.step_size, reached, MAX_SEGMENTS, "segments of motion")


def too_much_work(step_size: float, reached: float, max_count: int, what: str) -> Refusal:
    """Return the refusal of a step that takes more than `max_count` of `what`.

    A step up to `reached` [s] takes less: the text names the power of ten below it.
    """
    work = {"step_size": step_size, "max_count": max_count, "what": what}
    if reached > 0.0:
        return Refusal(refusal_texts.TOO_MUCH_WORK, exponent=floor(log10(reached)), **work)
    return Refusal(refusal_texts.TOO_MUCH_WORK_AT_ONCE, **work)


@dataclass(slots=True)
class Clock:
    """Time `elapsed` [s] of a step of `duration` [s], with the rounding error of that sum."""

    duration: float
    elapsed: float = 0.0
    carry: float = 0.0

    def advance(self, t: float) -> float:
        """Advance by `t` [s] and return the time left [s]; two-sum keeps the rounding errors."""
        before = self.elapsed
        total = before + t
        carried = total - before
        self.carry += (before - (total - carried)) + (t - carried)
        self.elapsed = total
        return (self.duration - total) - self.carry
