"""The friction laws by one face: start, advance, contact mode and friction force."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

from . import coulomb, lugre
from .bristle import Bristle, bristle_of
from .coulomb import Held, Moment, hold
from .device import Device, Inputs
from .motion import State
from .slow_motion import slow_law


class Law(Protocol):
    """A device under held inputs and one friction law."""

    @property
    def held(self) -> Held:
        """Coefficients of the motion."""
        ...

    def start(self, state: State, position: float) -> Moment:
        """The first moment, at drive and normal phase 0."""
        ...

    def advance(self, moment: Moment, duration: float) -> Moment:
        """The moment `duration` > 0 [s] later."""
        ...

    def mode(self, moment: Moment) -> int:
        """Contact mode under the held inputs."""
        ...

    def friction_force(self, moment: Moment, mode: int) -> float:
        """Friction force [N] on the slider, positive against +X."""
        ...


@dataclass(frozen=True, slots=True)
class CoulombLaw:
    """mu sgn(X') per unit load, set-valued at rest."""

    held: Held

    def start(self, state: State, position: float) -> Moment:
        """See Law."""
        return coulomb.start(self.held, state, position)

    def advance(self, moment: Moment, duration: float) -> Moment:
        """See Law."""
        return coulomb.advance(self.held, moment, duration)

    def mode(self, moment: Moment) -> int:
        """See Law."""
        return coulomb.mode_of(self.held, moment.state, moment.theta, moment.psi)

    def friction_force(self, moment: Moment, mode: int) -> float:
        """See Law."""
        return coulomb.friction_force(self.held, moment, mode)


@dataclass(frozen=True, slots=True)
class LugreLaw:
    """sigma_0 z + sigma_1 z' per unit load (eq. 8), integrated to a relative tolerance."""

    held: Held
    bristle: Bristle
    tolerance: float
    deflection: float

    def start(self, state: State, position: float) -> Moment:
        """See Law."""
        return lugre.start(self.held, self.bristle, state, position, self.deflection)

    def advance(self, moment: Moment, duration: float) -> Moment:
        """See Law."""
        return lugre.advance(self.held, self.bristle, self.tolerance, moment, duration)

    def mode(self, moment: Moment) -> int:
        """See Law."""
        return lugre.mode_of(self.held, moment.state, moment.psi)

    def friction_force(self, moment: Moment, mode: int) -> float:
        """See Law."""
        return lugre.friction_force(self.held, self.bristle, moment, mode)


def law_of(device: Device, inputs: Inputs) -> Law:
    """The device's friction law. Raises Refusal where device and law do not fit."""
    if device.fidelity == 0:
        return slow_law(device, inputs)
    held = hold(device, inputs)
    if device.friction_law == 0:
        return CoulombLaw(held)
    return LugreLaw(held, bristle_of(device), device.tolerance, device.initial_bristle_deflection)
