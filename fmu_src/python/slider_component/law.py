"""A device under held inputs, resolved or averaged, behind one interface."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import inf
from typing import Protocol

from . import events
from .budget import Budget
from .device import Device, Inputs
from .fast_vibration import steady_swing
from .friction_law import FrictionLaw
from .friction_laws import friction_law_of
from .held import Held, hold
from .moment import Counts, Moment
from .motion import State
from .orbit_motion import OrbitLaw, has_slow_motion
from .period import PeriodMeans
from .resolved_start import RESOLVED_TOLERANCE
from .slow_motion import slow_law


class Law(Protocol):
    """A device under held inputs."""

    @property
    def held(self) -> Held:
        """Coefficients of the motion."""
        ...

    def start(self, state: State, position: float) -> Moment:
        """The first moment, at drive and normal phase 0."""
        ...

    def advance(self, moment: Moment, duration: float) -> Moment:
        """The moment after a communication step of `duration` > 0 [s]."""
        ...

    def mode(self, moment: Moment) -> int:
        """Contact mode under the held inputs."""
        ...

    def friction_force(self, moment: Moment, mode: int) -> float:
        """Friction force [N] on the slider, positive against +X."""
        ...

    def swing(self, moment: Moment) -> tuple[float, float]:
        """Displacement [m] and velocity [m/s] of the resonator."""
        ...

    def settled(self, moment: Moment) -> Moment:
        """The moment with an estimate of the error up to now, before the law changes."""
        ...

    def slow_motion_error(self, moment: Moment) -> float:
        """The estimate of the error of the slow velocity [m/s]; 0 for resolved motion."""
        ...


@dataclass(frozen=True, slots=True)
class ResolvedLaw:
    """Resolved motion under a friction law."""

    held: Held
    friction: FrictionLaw

    def start(self, state: State, position: float) -> Moment:
        """See Law.

        A resonator that is not resolved vibrates steadily at once; the velocity is chosen so that
        the momentum of the pair is that of the initial values.
        """
        plant, device = self.held.plant, self.held.device
        if plant.resonator_amplitude is not None:
            _, rate = steady_swing(plant.resonator_amplitude, 0.0, plant.drive_frequency)
            velocity = state.velocity + device.mass_fraction * (state.rate - rate)
            state = state._replace(velocity=velocity)
        bristle = self.friction.first_bristle(self.held)
        at_rest = Moment(state, position, 0.0, 0.0, 0, Counts(), inf, PeriodMeans(), bristle)
        return replace(at_rest, mode=self.mode(at_rest))

    def advance(self, moment: Moment, duration: float) -> Moment:
        """See Law."""
        return events.advance(self.friction, self.held, moment, duration, Budget(duration))

    def mode(self, moment: Moment) -> int:
        """See Law."""
        return self.friction.mode(self.held, moment)

    def friction_force(self, moment: Moment, mode: int) -> float:
        """See Law."""
        return self.friction.force(self.held, moment, mode)

    def swing(self, moment: Moment) -> tuple[float, float]:
        """See Law."""
        plant = self.held.plant
        if plant.resonator_amplitude is None:
            return moment.state.displacement, moment.state.rate
        return steady_swing(plant.resonator_amplitude, moment.theta, plant.drive_frequency)

    def settled(self, moment: Moment) -> Moment:
        """See Law."""
        return moment

    def slow_motion_error(self, moment: Moment) -> float:
        """See Law."""
        return 0.0


def law_of(device: Device, inputs: Inputs) -> Law:
    """The law of a device. Raises Refusal where device and friction law do not fit."""
    friction = friction_law_of(device.friction_law)
    friction.check(device)
    held = hold(device, inputs)
    if device.fidelity == 0:
        law = slow_law(held, friction)
        if device.averaging_order == 1 or not has_slow_motion(device, inputs, law.fast):
            return law
        full = hold(replace(device, fidelity=2), inputs)
        finer = replace(full.device, tolerance=min(device.tolerance, RESOLVED_TOLERANCE))
        return OrbitLaw(held, full, replace(full, device=finer), friction, law.fast)
    return ResolvedLaw(held, friction)
