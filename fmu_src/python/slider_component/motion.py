"""The motion of a device under held inputs: resolved, averaged, or leaping over periods."""

from __future__ import annotations

from typing import Protocol

from .budget import Budget
from .device import System, steady_swing
from .events import advance, law_of
from .moment import Moment


class Motion(Protocol):
    """A device in motion under held inputs."""

    system: System

    def start(self) -> Moment:
        """The first moment, at drive and normal phase 0."""
        ...

    def advance(self, moment: Moment, duration: float) -> Moment:
        """The moment after a communication step of `duration` > 0 [s].

        Raises Refusal for more work than a step may take.
        """
        ...

    def mode(self, now: Moment) -> int:
        """Contact mode under the held inputs."""
        ...

    def friction_force(self, now: Moment, mode: int) -> float:
        """Friction force [N] on the slider, positive against +X."""
        ...

    def resonator(self, now: Moment) -> tuple[float, float]:
        """Displacement [m] and velocity [m/s] of the resonator."""
        ...

    def slow_motion_error(self, now: Moment) -> float:
        """The estimate of the error of the slow velocity [m/s]; 0 for resolved motion."""
        ...


class Resolved:
    """Resolved motion with one or two degrees of freedom (see `Motion`)."""

    def __init__(self, system: System) -> None:
        self.system, self.law = system, law_of(system)

    def start(self) -> Moment:
        """The initial values.

        A resonator that is not resolved vibrates steadily at once; the velocity is chosen so that
        the momentum of the pair is that of the initial values.
        """
        device, system = self.system.device, self.system
        velocity, rate = device.initial_velocity, device.initial_resonator_velocity
        if system.resonator_amplitude is not None:
            _, steady = steady_swing(system.resonator_amplitude, 0.0, system.drive_frequency)
            velocity += device.mass_fraction * (rate - steady)
        now = Moment(velocity, device.initial_resonator_displacement, rate, device.initial_position)
        if device.friction_law == 1:
            now.bristle = device.bristle_stiffness * device.initial_bristle_deflection
        now.mode = self.law.mode(system, now)
        return now

    def advance(self, moment: Moment, duration: float) -> Moment:
        """See Motion."""
        return advance(self.system, moment, duration, Budget(duration))

    def mode(self, now: Moment) -> int:
        """See Motion."""
        return self.law.mode(self.system, now)

    def friction_force(self, now: Moment, mode: int) -> float:
        """See Motion."""
        return self.law.force(self.system, now, mode)

    def resonator(self, now: Moment) -> tuple[float, float]:
        """See Motion."""
        return self.system.resonator(now.displacement, now.rate, now.theta)

    def slow_motion_error(self, now: Moment) -> float:
        """See Motion."""
        return 0.0
