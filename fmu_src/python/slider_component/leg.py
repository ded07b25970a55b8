"""A leg: motion without an event, up to the first zero of what it watches."""

from __future__ import annotations

from dataclasses import dataclass
from math import tau

from .first_zero import first_zero
from .held import Held
from .moment import Moment
from .motion import Motion, State
from .stick import Stick


@dataclass(slots=True)
class Leg:
    """A motion in contact mode `mode`, which ends after `t` [s] and `travelled` [m].

    `direction` is that of sliding, 0 where it does not matter, and `slides` tells whether the
    slider really moves in it, beyond rounding; `zero_of` is the watched signal that ends the leg,
    or None.
    """

    motion: Motion
    mode: int
    direction: int
    t: float
    travelled: float
    zero_of: int | None
    slides: bool

    @property
    def rests(self) -> bool:
        """Whether the slider is at rest."""
        return isinstance(self.motion, Stick)

    @property
    def stopped(self) -> bool:
        """Whether the leg ends at a stop of the slider."""
        return self.zero_of is not None and not self.rests

    @property
    def released(self) -> bool:
        """Whether the leg ends at a release of the slider."""
        return self.zero_of is not None and self.rests

    def finish(self, held: Held, now: Moment) -> None:
        """Move on from where the leg begins to its end, in its mode."""
        plant, motion, t = held.plant, self.motion, self.t
        now.state = motion.state(t)
        now.means, now.theta = now.means.advanced(
            t, now.theta, plant.drive_frequency, self.rests, motion.travel, self.travelled
        )
        now.psi = (now.psi + plant.normal_frequency * t) % tau
        now.position += self.travelled
        if self.slides and self.direction != now.counts.sliding:
            now.counts, now.event_age = now.counts.slid(self.direction), 0.0
        now.event_age += t
        if self.stopped:
            now.state = State(0.0, now.state.displacement, now.state.rate)


def followed(
    motion: Motion, mode: int, direction: int, longest: float, watched_from: float = 0.0
) -> Leg:
    """The leg that follows `motion` until it ends, for up to `longest` [s].

    What it watches is watched from `watched_from` [s] on.
    """
    t, zero_of = longest, None
    watches = motion.watches(longest) if longest > 0.0 else ()
    for index, watch in enumerate(watches):
        zero = first_zero(watch, t, watched_from)
        if zero is not None:
            t, zero_of = zero, index
    slides = direction != 0 and any(watch.signal(0.5 * t)[0] > watch.noise for watch in watches)
    return Leg(motion, mode, direction, t, motion.travel(t), zero_of, slides)
