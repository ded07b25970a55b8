"""Resolved motion of a device under held inputs; other motions have the same methods."""

from .budget import Budget
from .device import System, steady_swing
from .events import advance, law_of
from .moment import Moment


class Resolved:
    """Resolved motion with one or two degrees of freedom."""

    def __init__(self, system: System) -> None:
        self.system, self.law = system, law_of(system)

    def start(self) -> Moment:
        """The first moment, at drive and normal phase 0: the initial values.

        A resonator that is not resolved vibrates steadily at once; the velocity is chosen so that
        the momentum of the pair is that of the initial values.
        """
        device, system = self.system.device, self.system
        velocity, rate = device.initial_velocity, device.initial_resonator_velocity
        if not system.is_full:
            _, steady = steady_swing(system.resonator_amplitude, 0.0, system.drive_frequency)
            velocity += device.mass_fraction * (rate - steady)
        now = Moment(velocity, device.initial_resonator_displacement, rate, device.initial_position)
        if device.friction_law == 1:
            now.bristle = device.bristle_stiffness * device.initial_bristle_deflection
        now.mode = self.law.mode(system, now)
        return now

    def advance(self, moment: Moment, duration: float) -> Moment:
        """The moment after a communication step of `duration` > 0 [s].

        Raises Refusal for more work than a step may take.
        """
        return advance(self.system, moment, duration, Budget(duration))

    def mode(self, now: Moment) -> int:
        """Contact mode under the held inputs."""
        return self.law.mode(self.system, now)

    def friction_force(self, now: Moment, mode: int) -> float:
        """Friction force [N] on the slider, positive against +X."""
        return self.law.force(self.system, now, mode)

    def friction_power(self, now: Moment, mode: int) -> float:
        """Mean power of friction [W] of the last whole period, or since the start, or there."""
        momentary = self.friction_force(now, mode) * now.velocity
        return now.mean(now.friction_power, now.work, momentary)

    def resonator(self, now: Moment) -> tuple[float, float]:
        """Displacement [m] and velocity [m/s] of the resonator: its own or the steady ones."""
        system = self.system
        if system.is_full:
            return now.displacement, now.rate
        return steady_swing(system.resonator_amplitude, now.theta, system.drive_frequency)

    def slow_motion_error(self, now: Moment) -> float:
        """The estimate of the error of the slow velocity [m/s]; 0 for resolved motion."""
        return 0.0
