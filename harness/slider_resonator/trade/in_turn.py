"""Time several things in turn, so that a busy moment of the machine affects all of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from slider_resonator.output.progress import Progress, counted, no_progress


@dataclass(frozen=True)
class Timed:
    """Work to be timed `repeats` times: `seconds` does it once and returns the time taken."""

    name: str
    seconds: Callable[[], float]
    repeats: int


def in_turn(everything: Sequence[Timed], progress: Progress = no_progress) -> list[list[float]]:
    """Return the seconds of each; in every round, each with repeats left is timed once.

    `progress` receives the name of the work and the share of the repeats that is done.
    """
    seconds: list[list[float]] = [[] for _ in everything]
    total = sum(timed.repeats for timed in everything)
    done = 0
    for turn in range(max((timed.repeats for timed in everything), default=0)):
        for timed, taken in zip(everything, seconds, strict=True):
            if turn < timed.repeats:
                progress(counted(timed.name, done, total), done / total)
                taken.append(timed.seconds())
                done += 1
    return seconds
