"""Steady velocity and blocking force of the references, by the same shooting."""

from collections.abc import Callable, Sequence
from contextlib import suppress

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.device.drive_periods import common_period
from slider_resonator.device.held_inputs import HeldInputs
from slider_resonator.references.resolved.equations import initial_state
from slider_resonator.references.resolved.simulate import simulate as simulate_resolved
from slider_resonator.references.resolved.trajectory import Trajectory
from slider_resonator.steady.shooting import (
    STATE,
    NoPeriodicMotion,
    PeriodicRun,
    blocked_point,
    steady_point,
)

_INITIAL = tuple(f"initial_{name}" for name in ("position", *STATE))

Simulate = Callable[[Device, Sequence[HeldInputs], Array], Trajectory]
"""A reference: device, held inputs and times (n,) to its motion."""


class ReferenceMotion(PeriodicRun):
    """A reference under held inputs, whose steady motion is found by shooting.

    `phase` is in rad. `simulate` is any integrator. The state has the entries of `STATE` that there
    are: no resonator at fidelity 1, where its force is given, and no bristle with Coulomb friction.
    """

    def __init__(
        self,
        device: Device,
        phase: float,
        ratio: float,
        *,
        simulate: Simulate = simulate_resolved,
        tolerance: float = 1e-9,
    ) -> None:
        self.simulate = simulate
        self.tolerance = tolerance
        self.device = device
        self.phase = phase
        self.ratio = ratio
        self.drive_periods = common_period(ratio) or 0
        resonator = STATE[1:3] if device.fidelity == 2 else ()
        bristle = STATE[3:] if device.friction_law == 1 else ()
        self.names = (STATE[0], *resonator, *bristle)
        at_rest = device.tuned((name, 0.0) for name in _INITIAL)
        self._velocity_from_rest = initial_state(at_rest)[1]

    def steady_velocity(self, load: float, guess: float = 0.0) -> float | None:
        """Return the mean velocity (m/s) of the motion under a load (N), None where none is found.

        `guess` (m/s) is where the search begins.
        """
        with suppress(NoPeriodicMotion):
            if self.drive_periods:
                return steady_point(self, guess, load).displacement / self.period
        return None

    def blocking_force(self) -> float | None:
        """Return the load (N) that makes the mean velocity zero, None where none is found."""
        # Without preload the load varies alone and friction is of the order of its amplitude.
        size = self.device.max_friction
        with suppress(NoPeriodicMotion):
            if self.drive_periods:
                return blocked_point(self, *self.warm_up(0.0, 0.0), 0.0, size)[0]
        return None

    def run(self, state: Array, load: float, periods: int, samples: int = 1) -> tuple[Array, Array]:
        """Return states and travel."""
        initial = dict.fromkeys(_INITIAL, 0.0)
        initial |= {f"initial_{name}": float(x) for name, x in zip(self.names, state, strict=True)}
        initial["initial_velocity"] -= self._velocity_from_rest
        device = self.device.tuned(initial.items())
        times = np.linspace(0.0, periods * self.drive_period, samples + 1)[1:]
        held = [HeldInputs(0.0, float(times[-1]), self.phase, load, self.ratio)]
        run = self.simulate(device, held, times)
        return np.column_stack([getattr(run, name) for name in self.names]), run.position
