"""The load-speed curve of held orbits: mean friction over the held velocity, tabulated lazily.

Between the grazing velocities, beyond which the slider never reverses, F2 is smooth in the angle
chi of ``V = middle + reach cos(chi)``, also at grazing, where it has a square root in V. Panels of
Chebyshev nodes in chi are bisected until the last coefficients vanish; F2 has a kink where a
reversal meets the edge of a flight. Beyond grazing F2 is the mean friction of steady sliding.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field, replace

import numpy as np

from slider_resonator.arrays import Array
from slider_resonator.references.averaged.added_mass import slow_linearisation
from slider_resonator.references.averaged.held_orbit import (
    HeldOrbit,
    held_orbit,
)
from slider_resonator.references.averaged.held_orbit_that_sticks import (
    Simulate,
    any_held_orbit,
)
from slider_resonator.references.averaged.hold import Hold
from slider_resonator.references.resolved import located_events

_NODES = 12
_ANGLES = (np.arange(_NODES) + 0.5) * math.pi / _NODES
_FIRST_PANELS = 4
_DEEPEST = 8
"""Largest number of bisections of a first panel: a kink is then within 1e-3 of that panel."""


@dataclass
class HeldCurve:
    """Mean friction and added mass of the holds that differ from ``hold`` in velocity alone.

    Where the slider sticks the added mass is left out.

    ``accuracy`` is that of the table, over full friction; ``simulate`` the resolved motion for
    orbits in which the slider sticks.
    """

    hold: Hold
    accuracy: float = 1e-9
    simulate: Simulate = located_events.simulate
    orbits: int = field(default=0, init=False)
    """Orbits found so far."""

    def __post_init__(self) -> None:
        device = self.hold.device
        self._full = device.friction_faces * device.friction_coefficient * device.normal_preload
        scale = self.hold.vibration.velocity_amplitude
        beyond = [held_orbit(replace(self.hold, velocity=4.0 * sign * scale)) for sign in (-1, 1)]
        self._sliding = [orbit.mean_friction for orbit in beyond]
        theta = np.linspace(0.0, self.hold.period, 4096 * self.hold.turns)
        ripples = [
            self.hold.forced_velocity(theta) + orbit.panels.at(orbit.friction_response, theta)
            for orbit in beyond
        ]
        self.grazing = -float(ripples[0].max()), -float(ripples[1].min())
        """Velocities in m/s beyond which the slider never turns back, lowest first."""
        self._neighbour: HeldOrbit | None = None
        self._panels: dict[tuple[int, int], Array | None] = {}

    def orbit(self, velocity: float) -> HeldOrbit:
        """Return the held orbit at a velocity in m/s, iterated from the last one.

        Raises RuntimeError where there is none.
        """
        self.orbits += 1
        hold = replace(self.hold, velocity=velocity)
        self._neighbour = any_held_orbit(hold, self._neighbour, self.simulate)
        return self._neighbour

    def friction(self, velocity: float) -> tuple[float, float]:
        """Return F2 in N and 1 + kappa_m at a slow velocity in m/s."""
        low, high = self.grazing
        if not low < velocity < high:
            return self._sliding[velocity > 0.0], 1.0
        share = (2.0 * velocity - high - low) / (high - low)
        place = math.acos(share) / math.pi * _FIRST_PANELS
        index, depth = min(int(place), _FIRST_PANELS - 1), 0
        while True:
            table = self._panel(index, depth)
            if table is not None:
                local = 2.0 * (place * 2**depth - index) - 1.0
                friction, factor = np.polynomial.chebyshev.chebval(local, table)
                return float(friction), float(factor)
            depth += 1
            index = min(int(place * 2**depth), _FIRST_PANELS * 2**depth - 1)

    def _panel(self, index: int, depth: int) -> Array | None:
        """Return the Chebyshev coefficients of a panel, None where it has to be bisected."""
        key = (index, depth)
        if key not in self._panels:
            low, high = self.grazing
            chi = (index + 0.5 + 0.5 * np.cos(_ANGLES)) * math.pi / (_FIRST_PANELS * 2**depth)
            velocities = 0.5 * (low + high) + 0.5 * (high - low) * np.cos(chi)
            values = np.array([self._at(float(velocity)) for velocity in velocities])
            basis = np.cos(np.outer(np.arange(_NODES), _ANGLES))
            table = 2.0 / _NODES * basis @ values
            table[0] *= 0.5
            rough = float(np.abs(table[-2:, 0]).max()) > self.accuracy * self._full
            self._panels[key] = None if rough and depth < _DEEPEST else table
        return self._panels[key]

    def _at(self, velocity: float) -> tuple[float, float]:
        orbit = self.orbit(velocity)
        if orbit.shot:
            return orbit.mean_friction, 1.0
        return orbit.mean_friction, 1.0 + slow_linearisation(orbit).added_mass
