"""Prediction of the next stop: mostly near the phase of the stop one drive turn before."""

from __future__ import annotations

from math import tau
from typing import NamedTuple

MAX_DRIFT = 0.1
"""Largest change of the phase of a stop [rad] in a turn that counts as a drift."""


class Stops(NamedTuple):
    """Drive phase [rad] at which the slider last stopped after sliding `backward` and `forward`.

    `backward_drift` and `forward_drift` are the differences from the stops before. Before the first
    stop all are 0, an arbitrary guess.
    """

    backward: float = 0.0
    backward_drift: float = 0.0
    forward: float = 0.0
    forward_drift: float = 0.0

    def then(self, direction: int, theta: float) -> Stops:
        """The stops after the slider stops at `theta` [rad], having slid in `direction`."""
        if direction > 0:
            drift = theta - self.forward
            drift = drift if abs(drift) < MAX_DRIFT else 0.0
            return Stops(self.backward, self.backward_drift, theta, drift)
        drift = theta - self.backward
        drift = drift if abs(drift) < MAX_DRIFT else 0.0
        return Stops(theta, drift, self.forward, self.forward_drift)

    def expected(self, direction: int, theta: float, drive_frequency: float) -> float:
        """Time [s] from drive phase `theta` [rad] to the next stop if it drifts as before."""
        if direction > 0:
            return (self.forward + self.forward_drift - theta) % tau / drive_frequency
        return (self.backward + self.backward_drift - theta) % tau / drive_frequency


NO_STOPS = Stops()
"""The stops of a slider that has not stopped yet."""
