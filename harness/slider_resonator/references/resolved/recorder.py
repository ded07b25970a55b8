"""The samples, contact modes and counts of a run, for every integrator."""

import math

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.references.resolved.contact import SLIP_BACKWARD, SLIP_FORWARD
from slider_resonator.references.resolved.trajectory import Trajectory


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
        self._signals: list[Array] = []

    def pending(self, stop: float = np.inf) -> Array:
        """Return the times up to ``stop`` (s) that have no sample yet, shape (k,)."""
        waiting = self.times[self._next :]
        if not len(waiting) or waiting[0] > stop:
            return waiting[:0]
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
        modes = np.broadcast_to(np.asarray(mode, dtype=np.float64), len(states))
        bent = states[:, 4] if states.shape[1] > 4 else np.zeros(len(states))
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
        """Move in a direction (-1, 0 or 1) from a time in s on; the opposite of the last reverses.

        Motion in flight counts too.
        """
        if direction * self._direction < 0:
            self.reversal_times.append(time)
        self._direction = direction or self._direction

    def trajectory(self) -> Trajectory:
        """Return the trajectory of all samples."""
        signals = np.concatenate([np.empty((0, 8)), *self._signals])
        return Trajectory(
            time=self.times,
            position=signals[:, 0],
            velocity=signals[:, 1],
            resonator_displacement=signals[:, 2],
            resonator_velocity=signals[:, 3],
            normal_force=signals[:, 4],
            friction_force=signals[:, 5],
            bristle_deflection=signals[:, 6],
            contact_mode=signals[:, 7].astype(np.int64),
            reversals=len(self.reversal_times),
            event_times=np.array(self.event_times),
            reversal_times=np.array(self.reversal_times),
            modes=np.array(self.modes, dtype=np.int64),
            steps=self.steps,
            evaluations=self.evaluations,
        )
