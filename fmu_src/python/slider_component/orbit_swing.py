"""The resonator's own swing, by which motion differs from an orbit until it has decayed."""

from __future__ import annotations

from .contact import STICK
from .moment import Moment
from .motion import State
from .orbit_state import Swing
from .oscillator import free_response
from .plant import Plant


def swing_after(plant: Plant, swing: Swing, t: float) -> Swing:
    """The resonator's own swing `t` [s] later: it moves the pair, but not its momentum."""
    slip = plant.slip
    cosine, sine = free_response(slip, t)
    y, u = swing
    return Swing(
        y * (cosine + slip.decay * sine) + u * sine,
        u * (cosine - slip.decay * sine) - slip.stiffness * y * sine,
    )


def with_swing(moment: Moment, swing: Swing, share: float) -> Moment:
    """A moment on an orbit with the swing. A slider that sticks stays at rest."""
    velocity, displacement, rate = moment.state
    if moment.mode != STICK:
        velocity -= share * swing.rate
    moment.state = State(velocity, displacement + swing.displacement, rate + swing.rate)
    moment.position -= share * swing.displacement
    return moment
