"""The sequence of contact modes of a run, and the counts taken from it."""

from __future__ import annotations

from dataclasses import dataclass, field

from slider_resonator.references.resolved.contact import SLIP_BACKWARD, SLIP_FORWARD, STICK


@dataclass
class ContactRecord:
    """Counts reversals and sticks as ``Trajectory`` defines them while the modes are entered.

    ``direction`` is that of the last motion, 0 before the first.
    """

    mode: int | None = None
    direction: int = 0
    reversals: int = 0
    sticks: int = 0
    stick_time: float = 0.0
    event_times: list[float] = field(default_factory=list)

    def enter(self, mode: int, time: float) -> None:
        """Enter a contact mode at a time in s; entering the present mode changes nothing."""
        if mode == self.mode:
            return
        if self.mode is not None:
            self.event_times.append(time)
            self.sticks += mode == STICK
        if mode in (SLIP_BACKWARD, SLIP_FORWARD):
            self.slide(mode)
        self.mode = mode

    def slide(self, direction: int) -> None:
        """Move in a direction (-1, 0 or 1), in flight too; the opposite of the last reverses."""
        self.reversals += direction * self.direction < 0
        self.direction = direction or self.direction

    def stay(self, duration: float) -> None:
        """Stay in the present mode for a duration in s."""
        if self.mode == STICK:
            self.stick_time += duration
