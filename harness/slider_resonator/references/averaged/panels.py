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

_BARYCENTRIC = (-1.0) ** np.arange(NODES) * np.sqrt((1.0 - _NODES**2) * _WEIGHTS)
"""Weights of the barycentric formula of the interpolating polynomial."""

_AT_A_NODE = 1e-200

_PRIMITIVES = np.polynomial.legendre.legint(np.eye(NODES), lbnd=-1.0, axis=0)
_ANTIDERIVATIVE = np.polynomial.legendre.legvander(_NODES, NODES) @ _PRIMITIVES @ _ANALYSIS
"""From values at the nodes to the integral from -1 to each node."""

_TWICE = _ANTIDERIVATIVE @ _ANTIDERIVATIVE


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

    @cached_property
    def collocated(self) -> dict[Oscillator, _Collocation]:
        """What is already solved for oscillators on these panels."""
        return {}

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
        index = np.minimum(np.searchsorted(self.edges, wrapped, side="right") - 1, last)
        local = (wrapped - self.edges[index]) / self.half_widths[index, 0] - 1.0
        distances = local[:, np.newaxis] - _NODES
        distances[distances == 0.0] = _AT_A_NODE
        shares = _BARYCENTRIC / distances
        return np.asarray((shares * values[index]).sum(axis=1) / shares.sum(axis=1))

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
        solved = panels.collocated.get(self)
        if solved is None:
            solved = panels.collocated[self] = _Collocation.of(self, panels)
        acceleration = np.einsum("pnm,pm->pn", solved.inverse, drive)
        velocity = panels.half_widths * (acceleration @ _ANTIDERIVATIVE.T)
        displacement = panels.half_widths * (velocity @ _ANTIDERIVATIVE.T)
        weights = panels.half_widths * _WEIGHTS
        moved = (weights * velocity).sum(axis=1)
        gained = (weights * acceleration).sum(axis=1)
        if impulses is not None:
            gained += impulses / self.inertia
        # The state at the edges is affine in the state at the start, which the condition fixes.
        forced = np.zeros((len(moved) + 1, 2))
        for index, transfer in enumerate(solved.transfers):
            (to_here, by_rate), (by_place, kept) = transfer
            place, rate = forced[index].tolist()
            forced[index + 1] = (
                to_here * place + by_rate * rate + moved[index],
                by_place * place + kept * rate + gained[index],
            )
        start = np.linalg.solve(
            multiplier * np.eye(2) - solved.from_start[-1], forced[-1] - np.asarray(jump)
        )
        at_edges = (forced + solved.from_start @ start)[:-1]
        return (
            displacement + np.einsum("pnk,pk->pn", solved.displacement, at_edges),
            velocity + np.einsum("pnk,pk->pn", solved.velocity, at_edges),
        )


@dataclass(frozen=True)
class _Collocation:
    """What the response of an oscillator on some panels has in common for every drive.

    ``inverse`` gives y'' at the nodes from the drive, for a panel that begins at rest,
    ``displacement`` and ``velocity`` the free motion from a unit state at its start, shape (panels,
    NODES, 2). ``transfers`` take that state across each panel, ``from_start`` (panels + 1, 2, 2) to
    each edge.
    """

    inverse: Array
    displacement: Array
    velocity: Array
    transfers: list[list[list[float]]]
    from_start: Array

    @classmethod
    def of(cls, oscillator: Oscillator, panels: Panels) -> _Collocation:
        half = panels.half_widths[:, :, np.newaxis]
        once = half * _ANTIDERIVATIVE
        twice = half**2 * _TWICE
        damping, stiffness = oscillator.damping, oscillator.stiffness
        inverse = np.linalg.inv(
            oscillator.inertia * np.eye(NODES) + damping * once + stiffness * twice
        )
        past = panels.nodes - panels.edges[:-1, np.newaxis]
        drive = np.stack([np.full_like(past, -stiffness), -damping - stiffness * past], axis=2)
        acceleration = inverse @ drive
        velocity, displacement = once @ acceleration, twice @ acceleration
        velocity[:, :, 1] += 1.0
        displacement[:, :, 0] += 1.0
        displacement[:, :, 1] += past
        weights = panels.half_widths * _WEIGHTS
        transfers = np.stack(
            [
                np.einsum("pn,pnk->pk", weights, velocity) + np.array([1.0, 0.0]),
                np.einsum("pn,pnk->pk", weights, acceleration) + np.array([0.0, 1.0]),
            ],
            axis=1,
        )
        from_start = [np.eye(2)]
        for transfer in transfers:
            from_start.append(transfer @ from_start[-1])
        return cls(inverse, displacement, velocity, transfers.tolist(), np.stack(from_start))
