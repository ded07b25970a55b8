"""Find steady motion and blocking load of any period map."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import Protocol

from slider_resonator.steady.bracketing import bracketed_state
from slider_resonator.steady.newton import Vector
from slider_resonator.steady.shooting import FixedPoint, NoFixedPoint, blocking_point, fixed_point

WARM_UP = 20
"""Drive periods run before shooting, so that the resonator's own transient is mostly gone."""
TOLERANCE = 1e-11
"""Accuracy of the state in units of its scale, by default."""


@dataclass(frozen=True)
class WarmedUp:
    """A state (n,) after some periods, the typical size of each entry, and the mean velocity.

    Entry 0 is the velocity (m/s), and so is the mean, over the last drive period.
    """

    state: Vector
    scale: Vector
    mean_velocity: float

    def shifted(self, velocity: float) -> Vector:
        """Return the state shifted to a mean velocity (m/s)."""
        state = self.state.copy()
        state[0] += velocity - self.mean_velocity
        return state


class PeriodicRun(Protocol):
    """A device that is run over its common period of `period` seconds."""

    @property
    def period(self) -> float:
        """Length of the common period in seconds."""

    def __call__(self, state: Vector, load: float) -> tuple[Vector, float]:
        """Return state (n,) and displacement (m) after a common period under a load (N)."""

    def warm_up(self, velocity: float, load: float) -> WarmedUp:
        """Run some periods with the resonator at rest and the slider at `velocity` (m/s)."""


def steady_point(
    run: PeriodicRun, velocity: float, load: float, tolerance: float = TOLERANCE
) -> FixedPoint | NoFixedPoint:
    """Find the repeating motion under a load (N), near a mean velocity (m/s) if there is one."""
    loaded = partial(run, load=load)
    warm = run.warm_up(velocity, load)
    guess, scale = warm.shifted(velocity), warm.scale
    found = fixed_point(loaded, guess, scale, load=load, tolerance=tolerance)
    if isinstance(found, NoFixedPoint):
        between = bracketed_state(loaded, guess, scale)
        if between is not None:
            return fixed_point(loaded, between, scale, load=load, tolerance=tolerance)
    return found


def blocked_point(
    run: PeriodicRun, warm: WarmedUp, load: float, load_scale: float, tolerance: float = TOLERANCE
) -> FixedPoint | NoFixedPoint:
    """Find the load of the repeating motion without displacement, near `load` (N).

    `warm` comes from a warm-up under that load, `load_scale` (N) is a typical load.
    """
    displacement = float(warm.scale[0]) * run.period
    scales = (warm.scale, load_scale, displacement)
    return blocking_point(run, warm.shifted(0.0), load, *scales, tolerance=tolerance)
