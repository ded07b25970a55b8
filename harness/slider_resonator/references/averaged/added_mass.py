"""The mass that LuGre friction adds to the slow motion: the bristle lags behind the velocity.

Near a held orbit the slow motion decays by a multiplier rho over the period T of the orbit. The
slow equation with the factor (1 + kappa_m) has this rho when, with F2' = dF2/dV::

    1 + kappa_m = -Mt ln(rho) / (F2' T)

rho belongs to the variation of the motion that after a period is rho times what it was, F2' to the
one that repeats, p = dx/dV. Where F2' vanishes, so does the logarithm. There a unit of load lets
the motion drift along p, by dV a period, and ``rho = 1 + F2' dV`` up to the square of 1 - rho::

    x(theta + T) = x(theta) + p(theta) dV,    mean(v) = dV / 2

All three are found as the orbit is: velocity to friction to velocity.
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

_FLAT = 1e-5
"""Decay of the slow motion over a period up to which it is taken from the drift."""


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

    Raises ValueError for another friction law, RuntimeError where the iteration does not settle and
    where the motion is not slow against the vibration.
    """
    hold = orbit.hold
    if hold.device.friction_law != 1:
        raise ValueError(f"friction_law = {hold.device.friction_law!r} must be 1 (LuGre)")
    slope, tangent = _tangent(orbit)
    impulse = hold.period / hold.momentum_rate
    if abs(slope * impulse) > _FLAT:
        multiplier = _multiplier(orbit)
        if not multiplier > 0.0:
            raise RuntimeError(
                f"friction stops the motion at {hold.velocity!r} m/s within a period: nothing is "
                "slow"
            )
        return SlowLinearisation(slope, multiplier, -math.log(multiplier) / (slope * impulse) - 1.0)
    gained = _drift(orbit, tangent)
    decay = slope * gained
    stretched = gained * (math.log1p(decay) / decay if decay else 1.0)
    return SlowLinearisation(slope, 1.0 + decay, -stretched / impulse - 1.0)


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


def _multiplier(orbit: HeldOrbit) -> float:
    """Return rho."""
    hold, panels = orbit.hold, orbit.panels
    limit, bristle = hold.friction_limit(panels.nodes), orbit.bristle
    velocity = np.ones_like(panels.nodes)
    multiplier = 1.0
    for _ in range(_MOST_ITERATIONS):
        _, friction = bristle.variation(velocity, multiplier=multiplier)
        force = limit * friction / hold.momentum_rate
        lost, at_edges = panels.integral(force)
        multiplier = 1.0 - float(at_edges[-1])
        _, swing = hold.resonator.response(panels, force, multiplier=multiplier)
        fresh = 1.0 - lost - hold.device.mass_ratio * swing
        change = float(np.abs(fresh - velocity).max())
        velocity = fresh
        if change <= _CONVERGED:
            return multiplier
    raise RuntimeError(f"the slow decay at {hold.velocity!r} m/s does not settle")


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
        _, friction = bristle.variation(velocity, jump=gained * stretch_there)
        force = (limit * friction + 1.0) / hold.momentum_rate
        momentum, at_edges = panels.integral(-force)
        gained = float(at_edges[-1]) / momentum_there
        jump = gained * displacement_there, gained * swing_there
        _, swing = hold.resonator.response(panels, force, jump=jump)
        fresh = momentum - hold.device.mass_ratio * swing
        fresh += 0.5 * gained - panels.mean(fresh)
        change = float(np.abs(fresh - velocity).max())
        velocity = fresh
        if change <= _CONVERGED * abs(per_period):
            return gained
    raise RuntimeError(f"the drift at {hold.velocity!r} m/s does not settle")
