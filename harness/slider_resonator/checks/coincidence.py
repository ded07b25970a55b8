"""Events that coincide with a communication point: rounding decides which of the two is first."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.checks.measures.tube import Tube, no_tube
from slider_resonator.checks.period_means import COINCIDENCE
from slider_resonator.checks.reference_side import ReferenceSide


def beside_events(references: ReferenceSide, reference: str, name: str) -> Tube:
    """Return one output, with both of its values where an event coincides with a time.

    An event at the start or at a change of inputs has one right side, and is not meant.
    """
    signal = references.signal(reference, name)
    events = references.trajectory(reference).event_times
    changes = np.array([held.start for held in references.scene.schedule().held()])
    margin = COINCIDENCE * references.drive_period
    times = references.times
    coincide = _near(times, events, margin) & ~_near(times, changes, margin)
    if not coincide.any():
        return no_tube(signal)
    around = references.tube(reference, name, COINCIDENCE)
    lower = np.where(coincide, around.lower, signal)
    upper = np.where(coincide, around.upper, signal)
    return Tube(signal, lower, upper)


def _near(times: Array, instants: Array, margin: float) -> NDArray[np.bool_]:
    """Return for each time (s), shape (n,), whether one of the instants (s) is within a margin."""
    edges = np.concatenate([[-np.inf], np.sort(instants), [np.inf]])
    after = np.searchsorted(edges, times)
    distance = np.minimum(edges[after] - times, times - edges[after - 1])
    return np.asarray(distance <= margin, dtype=np.bool_)
