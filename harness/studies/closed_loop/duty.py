"""The task of the loop: a velocity to hold while the load steps."""

from bisect import bisect_right
from dataclasses import dataclass
from itertools import pairwise


@dataclass(frozen=True)
class LoadInterval:
    """A stretch of constant load (N) from `start` to `end` (s)."""

    start: float
    end: float
    load: float


@dataclass(frozen=True)
class Duty:
    """A velocity (m/s) to hold from rest, under loads (N) that step at times (s).

    `step` (s) is the communication step. After each step of the load, and after the start, the
    velocity may take `settling` (s) to come within `band` (a share of the reference), and then has
    to stay there.
    """

    reference: float = 0.06
    loads: tuple[tuple[float, float], ...] = (
        (0.0, 0.0),
        (2.0, 0.03),
        (3.5, 0.06),
        (5.0, -0.03),
        (6.5, 0.0),
    )
    end: float = 8.0
    step: float = 0.01
    settling: float = 0.6
    band: float = 0.02

    @property
    def intervals(self) -> list[LoadInterval]:
        """The stretches of constant load."""
        ends = [*self.loads, (self.end, 0.0)]
        return [LoadInterval(a[0], b[0], a[1]) for a, b in pairwise(ends)]

    @property
    def load_steps(self) -> list[LoadInterval]:
        """The stretches that begin with a step of the load: all but the start from rest."""
        return self.intervals[1:]

    @property
    def times(self) -> list[float]:
        """Begin of each step (s)."""
        return [index * self.step for index in range(round(self.end / self.step))]

    def load(self, time: float) -> float:
        """Return the load (N) from a time (s) on; the step's own time counts, despite rounding."""
        starts = [start for start, _ in self.loads]
        return self.loads[max(0, bisect_right(starts, time + 1e-6 * self.step) - 1)][1]
