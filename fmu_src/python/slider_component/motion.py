"""The interface of a motion in one contact mode, which a leg follows."""

from __future__ import annotations

from typing import NamedTuple, Protocol

from .first_zero import Watch

EPSILON = 2.0**-52
"""Spacing of floating point numbers above 1: the unit of rounding errors."""


class State(NamedTuple):
    """Slider velocity [m/s], resonator displacement [m] and velocity [m/s]."""

    velocity: float
    displacement: float
    rate: float


class Motion(Protocol):
    """Closed-form motion from a given state on, inputs held, contact mode unchanged."""

    def watches(self, horizon: float) -> tuple[Watch, ...]:
        """Signals that are positive while the mode lasts, up to `horizon` [s]."""
        ...

    def travel(self, t: float) -> float:
        """Displacement of the slider after `t` [s], in m."""
        ...

    def state(self, t: float) -> State:
        """State after `t` [s]."""
        ...
