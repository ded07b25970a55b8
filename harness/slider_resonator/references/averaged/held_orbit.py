"""The periodic motion of a device whose mean velocity is held, and its mean friction.

With theta = w t, total mass Mt = M + m and r = m / Mt the motion over a period is split into the
vibration without friction, (32)-(34), and the response to friction F, w1 and Y1::

    X' = V - v_q cos(theta - theta1) + w1 - r Y1'
    Mt w1' = -(F - F2),    F2 = mean(F),    mean(w1) = 0
    (1 - r) Y1'' + 2 xi wn Y1' + wn^2 Y1 = (F - F2) / Mt

The mean friction F2 is the force on the slow motion, and -F2 the load under which V is steady. The
response to friction is small compared with v_q, so fixed-point iteration converges: from velocity
to friction to velocity. Between two breaks (reversal, lift-off, touchdown) all functions are
smooth: collocation on panels between the breaks is exact to rounding.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.references.averaged.bristle_path import BristlePath, bristle_path
from slider_resonator.references.averaged.hold import Hold
from slider_resonator.references.averaged.panels import Panels
from slider_resonator.references.averaged.reversals import sign_changes

_CONVERGED = 1e-13
"""Change of the velocity in the last iteration, over v_q."""

_MAX_ITERATIONS = 100

_PATIENCE = 12
"""Iterations within which the change must fall to a tenth; close to sticking it does not."""


class NoSlidingOrbitError(RuntimeError):
    """The slider sticks in the held orbit, or the iteration does not converge."""


@dataclass(frozen=True)
class HeldOrbit:
    """A periodic motion; arrays at the nodes of ``panels`` over theta, SI units.

    ``slider_velocity`` is X', whose mean is the held velocity, ``mean_friction`` F2 in N;
    ``reversals`` are the angles in rad at which X' changes sign. ``iterations`` is their number;
    ``shot``: found by shooting with the resolved motion instead, as where the slider sticks.
    """

    hold: Hold
    panels: Panels
    slider_velocity: Array
    resonator_displacement: Array
    resonator_velocity: Array
    friction: Array
    mean_friction: float
    reversals: Array
    iterations: int
    shot: bool = False

    @cached_property
    def momentum_excess(self) -> Array:
        """w1 in m/s at the nodes: the momentum over the total mass, less V."""
        return momentum_response(self.hold, self.panels, self.friction - self.mean_friction)

    @cached_property
    def centre_excess(self) -> Array:
        """The integral of w1 over time in m at the nodes, with zero mean."""
        path, _ = self.panels.integral(self.momentum_excess / self.hold.device.drive_frequency)
        return path - self.panels.mean(path)

    @property
    def friction_response(self) -> Array:
        """The response of X' to friction in m/s at the nodes, w1 - r Y1'."""
        forced = self.hold.forced_velocity(self.panels.nodes)
        return self.slider_velocity - self.hold.velocity - forced

    @property
    def bristle(self) -> BristlePath:
        """The bristle of LuGre friction along this orbit."""
        return bristle_path(self.hold.device, self.panels, self.slider_velocity, self.reversals)


def held_orbit(hold: Hold, neighbour: HeldOrbit | None = None) -> HeldOrbit:
    """Return the orbit of a hold, iterated from that of a neighbour or from the vibration alone.

    Raises NoSlidingOrbitError where the slider sticks or the iteration does not converge.
    """
    device = hold.device
    scale = hold.vibration.velocity_amplitude
    panels = neighbour.panels if neighbour else hold.panels(np.empty(0), 0.0)
    response = neighbour.friction_response if neighbour else np.zeros_like(panels.nodes)
    changes: list[float] = []
    for iteration in range(1, _MAX_ITERATIONS + 1):

        def velocity_at(theta: Array, panels: Panels = panels, response: Array = response) -> Array:
            return hold.velocity + hold.forced_velocity(theta) + panels.at(response, theta)

        reversals = sign_changes(velocity_at, hold.period)
        panels = _panels_between(hold, reversals)
        velocity = velocity_at(panels.nodes.ravel()).reshape(panels.nodes.shape)
        friction = _friction(hold, panels, velocity, reversals)
        mean = panels.mean(friction)
        specific = (friction - mean) / (hold.momentum_rate * device.drive_frequency)
        displacement, swing = hold.resonator.response(panels, specific)
        swing = device.drive_frequency * swing
        response = momentum_response(hold, panels, friction - mean) - device.mass_ratio * swing
        fresh = hold.velocity + hold.forced_velocity(panels.nodes) + response
        change = float(np.abs(fresh - velocity).max())
        if change <= _CONVERGED * scale:
            forced_displacement, forced_swing = hold.forced_resonator(panels.nodes)
            orbit = HeldOrbit(
                hold=hold,
                panels=panels,
                slider_velocity=fresh,
                resonator_displacement=forced_displacement + displacement,
                resonator_velocity=forced_swing + swing,
                friction=friction,
                mean_friction=mean,
                reversals=reversals,
                iterations=iteration,
            )
            _check_slides(orbit)
            return orbit
        changes.append(change)
        if iteration > _PATIENCE and change > 0.1 * changes[-1 - _PATIENCE]:
            break
    raise NoSlidingOrbitError(
        f"the orbit at {hold.velocity!r} m/s with lead {hold.lead!r} rad does not converge"
    )


def momentum_response(hold: Hold, panels: Panels, force: Array) -> Array:
    """Return the response in m/s of the total mass to a friction force (N), both of zero mean."""
    gained, _ = panels.integral(-force / hold.momentum_rate)
    return gained - panels.mean(gained)


def _friction(hold: Hold, panels: Panels, velocity: Array, reversals: Array) -> Array:
    limit = hold.friction_limit(panels.nodes)
    if hold.device.friction_law == 0:
        return np.asarray(limit * np.sign(velocity[:, [velocity.shape[1] // 2]]))
    return limit * bristle_path(hold.device, panels, velocity, reversals).friction()


def _panels_between(hold: Hold, reversals: Array) -> Panels:
    breaks = np.concatenate([reversals, hold.contact_edges()])
    start = float(reversals[0]) if len(reversals) else 0.0
    device = hold.device
    if device.friction_law == 0 or not len(reversals):
        return hold.panels(breaks, start)
    # Half the angle in which a slider that leaves rest at v_q w slides mu / s0.
    path = device.bristle_stiffness * hold.vibration.ripple_amplitude / device.friction_coefficient
    return hold.panels(breaks, start, 0.5 * math.sqrt(2.0 / path))


def _check_slides(orbit: HeldOrbit) -> None:
    """Raise NoSlidingOrbitError where Coulomb friction would hold the slider at a reversal."""
    if orbit.hold.device.friction_law != 0 or not len(orbit.reversals):
        return
    after, before = orbit.panels.slopes_at_edges(orbit.slider_velocity)
    index = np.searchsorted(orbit.panels.edges, orbit.reversals - 1e-13)
    if (after[index] * before[index - 1] <= 0.0).any():
        raise NoSlidingOrbitError(
            f"the slider sticks in the orbit at {orbit.hold.velocity!r} m/s with lead "
            f"{orbit.hold.lead!r} rad"
        )
