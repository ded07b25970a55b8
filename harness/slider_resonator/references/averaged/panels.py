"""Smooth pieces of a periodic function: Gauss nodes on panels, integrals and linear responses.

Panels end where a function or one of its derivatives jumps, so that polynomials converge fast on
each. Values are arrays of shape (panels, NODES), the argument is an angle in rad.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from slider_resonator.arrays import Array

NODES = 16
"""Gauss-Legendre nodes in a panel."""

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(NODES)
_ANALYSIS = np.linalg.inv(np.polynomial.legendre.legvander(_NODES, NODES - 1))
"""From values at the nodes to Legendre coefficients."""

_PRIMITIVES = np.polynomial.legendre.legint(np.eye(NODES), lbnd=-1.0, axis=0)
_ANTIDERIVATIVE = np.polynomial.legendre.legvander(_NODES, NODES) @ _PRIMITIVES @ _ANALYSIS
"""From values at the nodes to the integral from -1 to each node."""


@dataclass(frozen=True)
class Panels:
    """Panels between ascending ``edges`` (rad, shape (panels + 1,)) that cover one period."""

    edges: Array

    @property
    def start(self) -> float:
        """Angle at which the first panel begins, rad."""
        return float(self.edges[0])

    @property
    def period(self) -> float:
        """Sum of all widths, rad."""
        return float(self.edges[-1] - self.edges[0])

    @cached_property
    def half_widths(self) -> Array:
        """Half the width of each panel, rad, shape (panels, 1)."""
        return 0.5 * np.diff(self.edges)[:, np.newaxis]

    @cached_property
    def nodes(self) -> Array:
        """Angles of the nodes, rad, shape (panels, NODES)."""
        return self.edges[:-1, np.newaxis] + self.half_widths * (1.0 + _NODES)

    def mean(self, values: Array) -> float:
        """Return the mean of values over the period."""
        return float(np.sum(self.half_widths * _WEIGHTS * values)) / self.period

    def integral(self, values: Array) -> tuple[Array, Array]:
        """Return the integral from the start to the nodes, and to the edges, (panels + 1,)."""
        across = (self.half_widths * _WEIGHTS * values).sum(axis=1)
        at_edges = np.concatenate([[0.0], np.cumsum(across)])
        within = self.half_widths * (values @ _ANTIDERIVATIVE.T)
        return at_edges[:-1, np.newaxis] + within, at_edges

    def at(self, values: Array, angles: Array) -> Array:
        """Return a periodic function, given by its values at the nodes, at angles of shape (n,)."""
        wrapped = self.start + (angles - self.start) % self.period
        last = len(self.edges) - 2
        index = np.clip(np.searchsorted(self.edges, wrapped, side="right") - 1, 0, last)
        local = (wrapped - self.edges[index]) / self.half_widths[index, 0] - 1.0
        coefficients = values[index] @ _ANALYSIS.T
        basis = np.polynomial.legendre.legvander(local, NODES - 1)
        return np.asarray(np.sum(basis * coefficients, axis=1), dtype=np.float64)

    def at_ends(self, values: Array) -> Array:
        """Return the values at the right end of each panel, shape (panels,)."""
        return np.asarray((values @ _ANALYSIS.T).sum(axis=1), dtype=np.float64)

    def slopes_at_edges(self, values: Array) -> tuple[Array, Array]:
        """Return the derivative at the left and the right end of each panel, (panels,) each."""
        coefficients = np.polynomial.legendre.legder((values @ _ANALYSIS.T).T, axis=0)
        ends = np.polynomial.legendre.legval(np.array([-1.0, 1.0]), coefficients)
        left, right = (ends / self.half_widths).T
        return left, right


@dataclass(frozen=True)
class Oscillator:
    """``inertia y'' + damping y' + stiffness y = g``, a prime being the derivative by the angle."""

    inertia: float
    damping: float
    stiffness: float

    def response(
        self,
        panels: Panels,
        drive: Array,
        impulses: Array | None = None,
        *,
        multiplier: float = 1.0,
        jump: tuple[float, float] = (0.0, 0.0),
    ) -> tuple[Array, Array]:
        """Return y and y' at the nodes, of the response that repeats.

        ``drive`` is g at the nodes, ``impulses`` (panels,) come at the ends of panels. After a
        period (y, y') is ``multiplier`` times what it was and ``jump`` more. Solved by collocation
        of y'' on every panel.
        """
        half = panels.half_widths[:, :, np.newaxis]
        count = len(half)
        once = half * _ANTIDERIVATIVE
        twice = once @ once
        past = panels.nodes - panels.edges[:-1, np.newaxis]
        matrix = self.inertia * np.eye(NODES) + self.damping * once + self.stiffness * twice
        unit_displacement = np.full_like(past, -self.stiffness)
        unit_velocity = -self.damping - self.stiffness * past
        right = np.stack([drive, unit_displacement, unit_velocity], axis=2)
        acceleration = np.linalg.solve(matrix, right)
        velocity, displacement = once @ acceleration, twice @ acceleration
        velocity[:, :, 2] += 1.0
        displacement[:, :, 1] += 1.0
        displacement[:, :, 2] += past
        weights = panels.half_widths * _WEIGHTS
        gained = np.einsum("pn,pnk->pk", weights, acceleration)
        moved = np.einsum("pn,pnk->pk", weights, velocity)
        gained[:, 2] += 1.0
        moved[:, 1] += 1.0
        struck = np.zeros(count) if impulses is None else impulses / self.inertia
        # State at the edges: affine in the state at the start, which the condition then fixes.
        states = np.zeros((count + 1, 2, 3))
        states[0, :, 1:] = np.eye(2)
        for index in range(count):
            transfer = np.array([moved[index, 1:], gained[index, 1:]])
            states[index + 1] = transfer @ states[index]
            states[index + 1, :, 0] += moved[index, 0], gained[index, 0] + struck[index]
        start = np.linalg.solve(
            multiplier * np.eye(2) - states[-1, :, 1:], states[-1, :, 0] - np.asarray(jump)
        )
        at_edges = states[:-1] @ np.concatenate([[1.0], start])
        factors = np.column_stack([np.ones(count), at_edges])
        return (
            np.einsum("pnk,pk->pn", displacement, factors),
            np.einsum("pnk,pk->pn", velocity, factors),
        )
