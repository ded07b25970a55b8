"""The error of a refused call; its text names the thing, its value and what it must be."""

from __future__ import annotations

from math import floor, log10

from . import refusal_texts


class Refusal(ValueError):
    """A refused call. The component is as it was before the call."""


def too_much_work(step_size: float, reached: float, max_count: int, what: str) -> Refusal:
    """Return the refusal of a step of `step_size` [s] that takes more than `max_count` of `what`.

    A step up to `reached` [s] takes less: the text names the power of ten below it.
    """
    if reached > 0.0:
        exponent = floor(log10(reached))
        return Refusal(refusal_texts.too_much_work(step_size, max_count, what, exponent))
    return Refusal(refusal_texts.too_much_work_at_once(step_size, max_count, what))
