"""The error that refuses a call; its text names the thing, its value and what is allowed."""

from __future__ import annotations

from math import floor, log10


class Refusal(ValueError):
    """A call that is refused. The state of the component is as it was before the call."""


def too_much_work(step_size: float, reached: float, most: int, what: str) -> Refusal:
    """The refusal of a step of `step_size` [s] that takes more than `most` of `what`.

    A step up to `reached` [s], named as a power of ten, takes less.
    """
    allowed = (
        f"one of at most 1e{floor(log10(reached))} s"
        if reached > 0.0
        else ("one under other forces")
    )
    return Refusal(
        f"doStep: communicationStepSize = {step_size!r} refused: it takes more than {most} {what}; "
        f"allowed is {allowed}"
    )
