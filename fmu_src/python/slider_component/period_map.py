"""The period map: the state of the full device after one period under a constant load.

A period is `turns` of the drive, after which the normal load repeats too; at drive phase theta = 0
the phase of the normal load is `lead`. The motion is resolved event by event with two degrees of
freedom, whatever the fidelity of the device.

The map begins at a section, the drive phase at which the vibration without friction is fastest
forward, or backward: near it the slider neither reverses nor sticks, and a bristle is fully bent.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import cos, inf, isfinite, pi, tau

from . import events
from .budget import Budget
from .contact import LIFTED, STICK
from .device import Device, Inputs
from .fast_vibration import FastVibration, fast_vibration
from .friction_law import FrictionLaw
from .friction_laws import friction_law_of
from .held import Held, hold
from .moment import Counts, Moment
from .motion import State
from .period import PeriodMeans
from .refusal import Refusal
from .trace import Trace
from .vibrating_load import VibratingLoad

MAP_TOLERANCE = 1e-10
"""Largest tolerance of a map under LuGre friction."""


@dataclass(frozen=True, slots=True)
class PeriodMap:
    """The period map of a device, at any lead and load.

    `held` is the full device, `fast` its vibration without friction. `period` [s]; `speed` [m/s],
    `swing` [m] and `force` [N] are the scales of velocity (v_q), resonator displacement and load
    (the force that stops v_q in a period). `states` is the number of states that are mapped: 3,
    with LuGre friction 4.
    """

    held: Held
    friction: FrictionLaw
    fast: FastVibration
    turns: int
    states: int
    period: float
    speed: float
    swing: float
    force: float

    def section_phase(self, direction: int) -> float:
        """Drive phase [rad] where the vibration is fastest in `direction`, 1 or -1."""
        return (self.fast.lag + (pi if direction > 0 else 0.0)) % tau

    def momentum_velocity(self, state: State, theta: float) -> float:
        """Momentum of the pair over total mass, without the part that the drive makes: W [m/s].

        W = X' + r Y' + D / (Mt w) cos(theta), D the amplitude of the drive force on the pair.
        """
        carried = state.velocity + self.held.plant.mass_fraction * state.rate
        return carried + self.fast.pair_velocity * cos(theta)

    def enter(self, lead: float, theta: float, state: State, bristle: float) -> Moment:
        """The moment at drive phase `theta` [rad] and position 0 with which a motion begins."""
        held = self.held.under(lead, 0.0)
        psi = self.held.inputs.frequency_ratio * theta % tau
        begin = Moment(state, 0.0, theta, psi, STICK, Counts(), inf, PeriodMeans(), bristle)
        begin.mode = self.friction.mode(held, begin)
        begin.counts = Counts(sliding=STICK if begin.mode == LIFTED else begin.mode)
        return begin

    def advance(
        self,
        lead: float,
        load: float,
        moment: Moment,
        duration: float,
        trace: Trace | None = None,
    ) -> Moment | None:
        """The moment `duration` [s] after one that `enter` gave, under `load` [N].

        A `trace` looks at the motion on its way. None where the motion takes too many legs or
        numbers leave the range of floating point.
        """
        try:
            held, budget = self.held.under(lead, load), Budget(duration)
            after = events.advance(self.friction, held, moment, duration, budget, trace)
        except (Refusal, ArithmeticError, ValueError):
            return None
        return after if isfinite(after.position + sum(after.state) + after.bristle) else None

    def sliding_friction(self, lead: float) -> float:
        """Mean friction [N] over a period in which the slider slides forward throughout."""
        device = self.held.device
        load = VibratingLoad(device, self.held.inputs.frequency_ratio, lead)
        mean = (load.flattened() if load.wave_number != 0.0 else load).at(0.0)
        return device.friction_faces * device.friction_coefficient * mean


def period_map(device: Device, ratio: float, turns: int) -> PeriodMap:
    """The map of `device` at a frequency ratio for which `turns * ratio` is an integer.

    Raises Refusal where device and friction law do not fit, and where undamped resonance leaves no
    steady vibration.
    """
    full = replace(device, fidelity=2, tolerance=min(device.tolerance, MAP_TOLERANCE))
    friction = friction_law_of(full.friction_law)
    friction.check(full)
    held, fast = hold(full, Inputs(frequency_ratio=ratio)), fast_vibration(full)
    w = held.plant.drive_frequency
    period, speed = tau * turns / w, fast.velocity
    swing = abs(fast.resonator) or speed / w
    return PeriodMap(
        held=held,
        friction=friction,
        fast=fast,
        turns=turns,
        states=3 if full.friction_law == 0 else 4,
        period=period,
        speed=speed,
        swing=swing,
        force=held.plant.total_mass * speed / period,
    )
