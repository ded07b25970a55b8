"""A look at a motion on its way."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from .leg import Leg
from .moment import Moment
from .motion import State


@dataclass(slots=True)
class Trace:
    """`see` gets index, state and position [m] at equal distances of time.

    From `first` [s] after the beginning of the motion on, then every `every` [s], `count` times in
    all. `seen` counts these.
    """

    first: float
    every: float
    count: int
    see: Callable[[int, State, float], None]
    seen: int = 0

    def look(self, leg: Leg, begin: Moment, elapsed: float) -> None:
        """Look at a leg that begins at a moment, `elapsed` [s] after the motion began."""
        while self.seen < self.count:
            t = self.first + self.seen * self.every - elapsed
            if t > leg.t:
                return
            state, travelled = leg.motion.state(max(t, 0.0)), leg.motion.travel(max(t, 0.0))
            self.see(self.seen, state, begin.position + travelled)
            self.seen += 1

    def look_at_end(self, end: Moment) -> None:
        """Look at the end of the motion, where rounding puts the last looks behind it."""
        while self.seen < self.count:
            self.see(self.seen, end.state, end.position)
            self.seen += 1
