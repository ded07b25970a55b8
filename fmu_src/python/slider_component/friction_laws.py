"""The friction laws of the interface."""

from __future__ import annotations

from .coulomb import COULOMB
from .friction_law import FrictionLaw
from .lugre import LUGRE
from .refusal import Refusal

FRICTION_LAWS: tuple[FrictionLaw, ...] = (COULOMB, LUGRE)
"""In the order of `friction_law`."""


def friction_law_of(number: int) -> FrictionLaw:
    """The law with this `friction_law`. Raises Refusal where no law has the number."""
    if not 0 <= number < len(FRICTION_LAWS):
        raise Refusal(f"friction_law = {number!r} refused: no law has this number")
    return FRICTION_LAWS[number]
