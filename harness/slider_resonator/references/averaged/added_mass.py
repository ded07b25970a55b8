"""The mass that friction adds to the slow motion: bristle and resonator lag behind the velocity.

Near a held orbit the slow motion decays by a multiplier rho over the period T of the orbit. The
slow equation with the factor (1 + kappa_m) has this rho when, with F2' = dF2/dV::

    1 + kappa_m = -Mt ln(rho) / (F2' T)

rho is the multiplier of the slow variation of the motion: after a period that is rho times itself.
F2' belongs to the periodic variation p = dx/dV. Both F2' and ln(rho) may vanish together. There a
unit of load makes the motion drift along p by dV in a period, and ``rho = 1 + F2' dV`` with an
error of the order (1 - rho)^2::

    x(theta + T) = x(theta) + p(theta) dV,    mean(v) = dV / 2

rho, F2' and dV are found by the same iteration as the orbit, from velocity to friction to velocity.
A change dv of the velocity moves a Coulomb reversal by ``-dv / v'``; that is an impulse of friction
of ``2 f |dv / v'|``.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.references.averaged.held_orbit import HeldOrbit
from slider_resonator.references.averaged.panels import Panels

_CONVERGED = 1e-13
_MAX_ITERATIONS = 300

_FLAT = 1e-5
"""Decay of the slow motion over a period below which the factor follows from the drift."""


@dataclass(frozen=True)
class SlowLinearisation:
    """Linearisation of the slow motion about a held orbit.

    ``friction_slope`` is F2' in N s/m, ``multiplier`` rho over a period of the orbit, and
    ``added_mass`` kappa_m, the added mass over the total one.
    """

    friction_slope: float
    multiplier: float
    added_mass: float


@dataclass(frozen=True)
class _Variation:
    """A first variation of the motion: momentum, stretch and resonator at the nodes."""

    momentum: Array
    stretch: Array
    swing: tuple[Array, Array]


@dataclass(frozen=True)
class _FrictionResponse:
    """The variation of friction over ``momentum_rate``: density at the nodes, and impulses.

    ``impulses``, (panels,), act at the ends of panels, where a Coulomb reversal moves.
    """

    panels: Panels
    density: Array
    impulses: Array
    stretch: Array

    def mean(self) -> float:
        """Return the mean over the period."""
        return self.panels.mean(self.density) + float(self.impulses.sum()) / self.panels.period

    def lost(self, constant: float = 0.0) -> tuple[Array, float]:
        """Return the momentum lost from the start to the nodes, and in the period.

        ``constant`` adds to the density.
        """
        within, at_edges = self.panels.integral(self.density + constant)
        before = np.concatenate([[0.0], np.cumsum(self.impulses)])
        return within + before[:-1, np.newaxis], float(at_edges[-1] + before[-1])


def slow_linearisation(orbit: HeldOrbit) -> SlowLinearisation:
    """Return the slow linearisation about an orbit in which the slider does not stick.

    Raises ValueError for an orbit found by shooting, RuntimeError where the iteration does not
    converge and where the motion is not slow compared with the vibration.
    """
    if orbit.shot:
        raise ValueError(
            "the orbit was found by shooting: must be one found by iteration, whose reversals are "
            "exact"
        )
    hold = orbit.hold
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


def _friction_response_of(orbit: HeldOrbit) -> Callable[..., _FrictionResponse]:
    """Return a function from a change of velocity (m/s, at the nodes) to that of friction.

    It takes, by name, the ``multiplier`` and the ``jump`` of the stretch over a period.
    """
    hold, panels = orbit.hold, orbit.panels
    none = np.zeros(len(panels.nodes))
    if hold.device.friction_law == 0:
        _, before = panels.slopes_at_edges(orbit.slider_velocity)
        ends = panels.edges[1:]
        near = np.abs(ends[:, np.newaxis] - orbit.reversals) < 1e-12
        # The panels start at a reversal, which comes again where they end.
        turned = near.any(axis=1) | ((ends == ends[-1]) & (len(orbit.reversals) > 0))
        limit = hold.friction_limit(ends) / hold.momentum_rate
        gain = np.where(turned, 2.0 * limit / np.abs(before), 0.0)
        still = np.zeros_like(panels.nodes)
        return lambda change, **_: _FrictionResponse(
            panels, still, gain * panels.at_ends(change), still
        )
    limit = hold.friction_limit(panels.nodes) / hold.momentum_rate
    bristle = orbit.bristle

    def response(change: Array, *, multiplier: float = 1.0, jump: float = 0.0) -> _FrictionResponse:
        stretch, friction = bristle.variation(change, multiplier=multiplier, jump=jump)
        return _FrictionResponse(panels, limit * friction, none, stretch)

    return response


def _tangent(orbit: HeldOrbit) -> tuple[float, _Variation]:
    """Return F2' and the periodic variation whose mean velocity is 1."""
    hold, panels, response_to = orbit.hold, orbit.panels, _friction_response_of(orbit)
    velocity = np.ones_like(panels.nodes)
    for _ in range(_MAX_ITERATIONS):
        response = response_to(velocity)
        slope = response.mean()
        lost, _ = response.lost(-slope)
        momentum = 1.0 - lost + panels.mean(lost)
        swing = hold.resonator.response(panels, response.density - slope, response.impulses)
        fresh = momentum - hold.device.mass_ratio * swing[1]
        change = float(np.abs(fresh - velocity).max())
        velocity = fresh
        if change <= _CONVERGED:
            return slope * hold.momentum_rate, _Variation(momentum, response.stretch, swing)
    raise RuntimeError(f"the tangent at {hold.velocity!r} m/s does not converge")


def _multiplier(orbit: HeldOrbit) -> float:
    """Return rho, the multiplier of the slow motion over a period."""
    hold, panels, response_to = orbit.hold, orbit.panels, _friction_response_of(orbit)
    velocity = np.ones_like(panels.nodes)
    multiplier = 1.0
    for _ in range(_MAX_ITERATIONS):
        response = response_to(velocity, multiplier=multiplier)
        lost, in_all = response.lost()
        multiplier = 1.0 - in_all
        _, swing = hold.resonator.response(
            panels, response.density, response.impulses, multiplier=multiplier
        )
        fresh = 1.0 - lost - hold.device.mass_ratio * swing
        change = float(np.abs(fresh - velocity).max())
        velocity = fresh
        if change <= _CONVERGED:
            return multiplier
    raise RuntimeError(f"the slow decay at {hold.velocity!r} m/s does not converge")


def _drift(orbit: HeldOrbit, tangent: _Variation) -> float:
    """Return dV in m/s: the change of V by a unit of load in a period."""
    hold, panels, response_to = orbit.hold, orbit.panels, _friction_response_of(orbit)
    load = 1.0 / hold.momentum_rate
    origin = np.array([panels.start])
    stretch_there, momentum_there, displacement_there, swing_there = (
        float(panels.at(values, origin)[0])
        for values in (tangent.stretch, tangent.momentum, *tangent.swing)
    )
    gained = -hold.period * load
    velocity = np.zeros_like(panels.nodes)
    for _ in range(_MAX_ITERATIONS):
        response = response_to(velocity, jump=gained * stretch_there)
        lost, in_all = response.lost(load)
        gained = -in_all / momentum_there
        jump = gained * displacement_there, gained * swing_there
        _, swing = hold.resonator.response(
            panels, response.density + load, response.impulses, jump=jump
        )
        fresh = -lost - hold.device.mass_ratio * swing
        fresh += 0.5 * gained - panels.mean(fresh)
        change = float(np.abs(fresh - velocity).max())
        velocity = fresh
        if change <= _CONVERGED * hold.period * load:
            return gained
    raise RuntimeError(f"the drift at {hold.velocity!r} m/s does not converge")
