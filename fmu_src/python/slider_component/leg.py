"""A leg: motion without an event, up to the first zero of what it watches."""

from __future__ import annotations

from dataclasses import dataclass
from math import tau

from .first_zero import exceeds_noise, first_zero
from .held import Held
from .moment import Moment
from .motion import Motion, State
from .stick import Stick


@dataclass(slots=True)
class Leg:
    """A motion in contact mode `mode`, which ends after `t` [s] and `travelled` [m].

    `direction` is that of sliding, 0 where it does not matter; `turns`: the slider moves, beyond
    rounding, in another direction than it slid before; `zero_of` is the index of the watched signal
    whose zero ends the leg, or None; `rests`: the slider is at rest.
    """

    motion: Motion
    mode: int
    direction: int
    t: float
    travelled: float
    zero_of: int | None
    turns: bool
    rests: bool

    @property
    def released(self) -> bool:
        """Whether the leg ends at a release of the slider."""
        return self.zero_of is not None and self.rests

    def finish(self, held: Held, now: Moment) -> None:
        """Advance `now` from the start of the leg to its end, in the mode of the leg."""
        plant, motion, t = held.plant, self.motion, self.t
        state = motion.state(t)
        stopped = self.zero_of is not None and not self.rests
        now.state = State(0.0, state.displacement, state.rate) if stopped else state
        now.means, now.theta = now.means.advanced(
            t, now.theta, plant.drive_frequency, self.rests, motion.travel, self.travelled
        )
        now.psi = (now.psi + plant.normal_frequency * t) % tau
        now.position += self.travelled
        if self.turns:
            now.counts, now.event_age = now.counts.slid(self.direction), 0.0
        now.event_age += t
        if stopped:
            now.stops = now.stops.then(self.direction, now.theta)


def followed(
    motion: Motion,
    held: Held,
    now: Moment,
    direction: int,
    longest: float,
    watched_from: float = 0.0,
) -> Leg:
    """The leg that follows `motion` from `now` until it ends, for up to `longest` [s].

    What it watches is watched from `watched_from` [s] on.
    """
    t, zero_of, expected, turns = longest, None, None, False
    watches = motion.watches(longest) if longest > 0.0 else ()
    if direction != 0:
        expected = now.stops.expected(direction, now.theta, held.plant.drive_frequency)
    index = 0
    for watch in watches:
        zero = first_zero(watch, t, watched_from, expected)
        if zero is not None:
            t, zero_of = zero, index
        index += 1  # noqa: SIM113 - enumerate takes longer for the usual single watch
    if watches and direction not in (0, now.counts.sliding):
        turns = exceeds_noise(watches[0], t)
    rests = isinstance(motion, Stick)
    return Leg(motion, now.mode, direction, t, motion.travel(t), zero_of, turns, rests)
