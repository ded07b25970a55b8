"""Sliding or flight in closed form, by the form that serves the device."""

from __future__ import annotations

from .contact import LIFTED
from .held import Held
from .moment import Moment
from .regular_slide import RegularSlide
from .split_slide import SplitSlide


def slide(held: Held, now: Moment, direction: int) -> SplitSlide | RegularSlide:
    """Sliding in `direction` under full friction, or flight in contact mode LIFTED.

    The velocity is watched in `direction`, unless that is 0.
    """
    sign = 0 if now.mode == LIFTED else direction
    chi = now.psi + held.plant.phase
    if held.split is not None:
        return SplitSlide(held.split, sign, now.state, now.theta, chi, direction)
    return RegularSlide(held.plant, sign, now.state, now.theta, chi, direction)
