"""The sampled motion that every reference integrator returns, and how a run records it."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.references.resolved.contact import SLIP_BACKWARD, SLIP_FORWARD


@dataclass(frozen=True)
class Trajectory:
    """Signals at ``time`` (arrays of shape (n,), SI units), event record and cost of a run.

    ``contact_mode`` is -1 slip backward, 0 stick, 1 slip forward, 2 lifted. ``friction_force`` is F
    as it acts in M X'' = -F - load + ... (in stick the force that holds the slider).
    ``event_times`` are the instants of every change of contact mode, s, and ``modes`` the contact
    modes at the first instant and from each of them on: one more. A reversal is a slip that starts
    opposite to the slip before it, whether directly, after a stick or after a flight;
    ``reversal_times`` (s) are NaN where they are not located.

    ``bristle_deflection`` is z of (8) in m, 0 with Coulomb friction. Bristles never stick: with
    them ``contact_mode`` is the sign of the velocity (2 while lifted).
    """

    time: Array
    position: Array
    velocity: Array
    resonator_displacement: Array
    resonator_velocity: Array
    normal_force: Array
    friction_force: Array
    bristle_deflection: Array
    contact_mode: NDArray[np.int64]
    event_times: Array
    reversal_times: Array
    modes: NDArray[np.int64]
    steps: int
    evaluations: int


_SIGNALS = (
    *("position", "velocity", "resonator_displacement", "resonator_velocity"),
    *("normal_force", "friction_force", "bristle_deflection"),
)


class Recorder:
    """Keeps samples at ``times`` (shape (n,), s, ascending) and counts while a run is followed.

    Counts are those of ``Trajectory``, taken while contact modes are entered.
    """

    def __init__(self, times: Array) -> None:
        self.times = times
        self.event_times: list[float] = []
        self.reversal_times: list[float] = []
        self.modes: list[int] = []
        self.steps = 0
        self.evaluations = 0
        self._direction = 0  # of the last motion, 0 before the first
        self._next = 0
        self._signals: list[Array] = [np.empty((0, 8))]

    def pending(self, stop: float = np.inf) -> Array:
        """Return the times up to ``stop`` (s) that have no sample yet, shape (k,)."""
        waiting = self.times[self._next :]
        return waiting[: np.searchsorted(waiting, stop, side="right")]

    def keep(
        self,
        states: Array,
        resonator: tuple[Array, Array],
        forces: tuple[Array, Array],
        mode: int | Array,
    ) -> None:
        """Keep the samples of the next k times, SI units.

        ``states`` (k, m) begin with position and velocity, and have the bristle deflection as a
        fifth where there is one; ``resonator`` is its displacement and velocity, ``forces`` are
        normal force and friction, (k,) each. ``mode`` is the contact mode of all, or of each.
        """
        modes = np.full(len(states), mode, np.float64)
        bent = states[:, 4] if states.shape[1] > 4 else 0.0 * modes
        rows = np.column_stack([states[:, :2], *resonator, *forces, bent, modes])
        self._signals.append(rows)
        self._next += len(rows)

    def enter(self, mode: int, time: float) -> None:
        """Enter a contact mode at a time in s; entering the present mode changes nothing."""
        if self.modes and mode == self.modes[-1]:
            return
        if self.modes:
            self.event_times.append(time)
        if mode in (SLIP_BACKWARD, SLIP_FORWARD):
            self.slide(mode, time)
        self.modes.append(mode)

    def slide(self, direction: int, time: float = math.nan) -> None:
        """Slide in a direction (-1, 0 or 1) from a time in s on; the opposite one reverses."""
        if direction * self._direction < 0:
            self.reversal_times.append(time)
        self._direction = direction or self._direction

    def trajectory(self) -> Trajectory:
        """Return the trajectory of all samples."""
        signals = np.concatenate(self._signals)
        named = dict(zip(_SIGNALS, signals.T[:-1], strict=True))
        return Trajectory(
            time=self.times,
            **named,
            contact_mode=signals[:, -1].astype(np.int64),
            event_times=np.array(self.event_times),
            reversal_times=np.array(self.reversal_times),
            modes=np.array(self.modes, dtype=np.int64),
            steps=self.steps,
            evaluations=self.evaluations,
        )
