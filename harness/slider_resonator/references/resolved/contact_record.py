"""The sequence of contact modes of a run, and the counts taken from it."""

from __future__ import annotations

import math
from dataclasses import dataclass, field

from slider_resonator.references.resolved.contact import SLIP_BACKWARD, SLIP_FORWARD, STICK


@dataclass
class ContactRecord:
    """Counts reversals and sticks as ``Trajectory`` defines them while the modes are entered.

    ``direction`` is that of the last motion, 0 before the first. ``modes`` are the first mode and
    that entered at each of the ``event_times`` (s); ``reversal_times`` (s) are NaN where an
    integrator does not locate reversals.
    """

    mode: int | None = None
    direction: int = 0
    sticks: int = 0
    stick_time: float = 0.0
    event_times: list[float] = field(default_factory=list)
    reversal_times: list[float] = field(default_factory=list)
    modes: list[int] = field(default_factory=list)

    @property
    def reversals(self) -> int:
        """Number of reversals so far."""
        return len(self.reversal_times)

    def enter(self, mode: int, time: float) -> None:
        """Enter a contact mode at a time in s; entering the present mode changes nothing."""
        if mode == self.mode:
            return
        if self.mode is not None:
            self.event_times.append(time)
            self.sticks += mode == STICK
        if mode in (SLIP_BACKWARD, SLIP_FORWARD):
            self.slide(mode, time)
        self.modes.append(mode)
        self.mode = mode

    def slide(self, direction: int, time: float = math.nan) -> None:
        """Move in a direction (-1, 0 or 1) from a time in s on; the opposite of the last reverses.

        Motion in flight counts too.
        """
        if direction * self.direction < 0:
            self.reversal_times.append(time)
        self.direction = direction or self.direction

    def stay(self, duration: float) -> None:
        """Stay in the present mode for a duration in s."""
        if self.mode == STICK:
            self.stick_time += duration
