"""The samples and counts of a run, for every integrator."""

from __future__ import annotations

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.references.resolved.contact_record import ContactRecord
from slider_resonator.references.resolved.trajectory import Trajectory


class Recorder:
    """Keeps samples at ``times`` (shape (n,), s, ascending) and counts while a run is followed."""

    def __init__(self, times: Array) -> None:
        self.times = times
        self.contact = ContactRecord()
        self.steps = 0
        self.evaluations = 0
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
            reversals=self.contact.reversals,
            sticks=self.contact.sticks,
            stick_time=self.contact.stick_time,
            event_times=np.array(self.contact.event_times),
            reversal_times=np.array(self.contact.reversal_times),
            modes=np.array(self.contact.modes, dtype=np.int64),
            steps=self.steps,
            evaluations=self.evaluations,
        )
