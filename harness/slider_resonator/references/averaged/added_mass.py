"""The mass that LuGre friction adds to the slow motion: the bristle lags behind the velocity.

Near a held orbit p = dx/dV is the change of the periodic motion x with V, F2' that of the mean
friction. Under a unit of load on top of the steady one the motion drifts, and to first order it
is the same motion after a period, shifted along p::

    x(theta + T) = x(theta) + p(theta) dV,    mean(v) = dV / 2

dV is what a unit of load adds to V in a period at first, and ``rho = 1 + F2' dV`` the multiplier of
the slow motion. The slow equation with the factor (1 + kappa_m) has this rho when

    1 + kappa_m = -Mt ln(1 + F2' dV) / (F2' T)

Both motions are found as the orbit is: velocity to friction to velocity.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.references.averaged.held_orbit import HeldOrbit

Array = NDArray[np.float64]

_CONVERGED = 1e-13
_MOST_ITERATIONS = 300


@dataclass(frozen=True)
class SlowLinearisation:
    """How the slow motion departs from a held orbit.

    ``friction_slope`` is F2' in N s/m, ``multiplier`` rho over a period of the orbit, and
    ``added_mass`` kappa_m, the added mass over the total one.
    """

    friction_slope: float
    multiplier: float
    added_mass: float


@dataclass(frozen=True)
class _Variation:
    """A first variation of the motion: velocity at the nodes, momentum, stretch, resonator."""

    velocity: Array
    momentum: Array
    stretch: Array
    swing: tuple[Array, Array]


def slow_linearisation(orbit: HeldOrbit) -> SlowLinearisation:
    """Return the slow linearisation about an orbit under LuGre friction.

    Raises ValueError for another friction law, RuntimeError where the iteration does not settle.
    """
    hold = orbit.hold
    if hold.device.friction_law != 1:
        raise ValueError(f"friction_law = {hold.device.friction_law!r} must be 1 (LuGre)")
    slope, tangent = _tangent(orbit)
    gained = _drift(orbit, tangent)
    duration = hold.period / hold.device.drive_frequency
    decay = slope * gained
    stretched = gained * (math.log1p(decay) / decay if decay else 1.0)
    added = -hold.device.total_mass * stretched / duration - 1.0
    return SlowLinearisation(slope, 1.0 + decay, added)


def _tangent(orbit: HeldOrbit) -> tuple[float, _Variation]:
    """Return F2' and the periodic variation whose mean velocity is 1."""
    hold, panels = orbit.hold, orbit.panels
    limit, bristle = hold.friction_limit(panels.nodes), orbit.bristle
    velocity = np.ones_like(panels.nodes)
    for _ in range(_MOST_ITERATIONS):
        stretch, friction = bristle.variation(velocity)
        slope = panels.mean(limit * friction)
        force = (limit * friction - slope) / hold.momentum_rate
        gained, _ = panels.integral(-force)
        momentum = 1.0 + gained - panels.mean(gained)
        swing = hold.resonator.response(panels, force)
        fresh = momentum - hold.device.mass_ratio * swing[1]
        change = float(np.abs(fresh - velocity).max())
        velocity = fresh
        if change <= _CONVERGED:
            return slope, _Variation(velocity, momentum, stretch, swing)
    raise RuntimeError(f"the tangent at {hold.velocity!r} m/s does not settle")


def _drift(orbit: HeldOrbit, tangent: _Variation) -> float:
    """Return dV, what a unit of load adds to V in a period, in m/s."""
    hold, panels = orbit.hold, orbit.panels
    limit, bristle = hold.friction_limit(panels.nodes), orbit.bristle
    per_period = -hold.period / hold.momentum_rate
    origin = np.array([panels.start])
    stretch_there, momentum_there, displacement_there, swing_there = (
        float(panels.at(values, origin)[0])
        for values in (tangent.stretch, tangent.momentum, *tangent.swing)
    )
    gained = per_period
    velocity = np.zeros_like(panels.nodes)
    for _ in range(_MOST_ITERATIONS):
        _, friction = bristle.variation(velocity, gained * stretch_there)
        force = (limit * friction + 1.0) / hold.momentum_rate
        momentum, at_edges = panels.integral(-force)
        gained = float(at_edges[-1]) / momentum_there
        jump = gained * displacement_there, gained * swing_there
        _, swing = hold.resonator.response(panels, force, jump)
        fresh = momentum - hold.device.mass_ratio * swing
        fresh += 0.5 * gained - panels.mean(fresh)
        change = float(np.abs(fresh - velocity).max())
        velocity = fresh
        if change <= _CONVERGED * abs(per_period):
            return gained
    raise RuntimeError(f"the drift at {hold.velocity!r} m/s does not settle")
