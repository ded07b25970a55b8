"""Periodic motion of the full device as a fixed point of the period map.

Steady motion is one under the given load, blocked motion one without travel under a load that is
looked for. Newton's method finds both, from first-order averages on.
"""

from dataclasses import dataclass
from math import inf

from .budget import Budget
from .device import steady_swing
from .moment import Moment
from .period_map import NoMapError, PeriodMap, fast_of

Vector = list[float]
Matrix = list[Vector]

BESIDE = 1e-6
"""Change of an unknown by which derivatives are taken; unknowns are over their scales."""

MAX_CHANGE = 0.2
"""Largest change of an unknown in an iteration."""

CONVERGED = 1e-10
"""Change at which the iteration ends: the next one would be rounding."""

MAX_ITERATIONS = 16

SMALLEST_PIVOT = 1e-13
"""Smallest pivot that counts as different from 0, over the largest entry of a matrix."""
SQUARINGS = 24
DECAYED = 0.5
"""Squarings of the linear map after which it must have decayed: in 2^24 periods, more than rounding
of its derivatives could make it."""


@dataclass(frozen=True, slots=True)
class PeriodicMotion:
    """A periodic motion that is looked for, at normal phase `psi` [rad] at the section.

    Unknowns are the slow velocity, the fast states and, for motion that is `blocked`, the load.
    All maps of the search draw from one `budget`.
    """

    map: PeriodMap
    psi: float
    blocked: bool
    budget: Budget

    @property
    def force(self) -> float:
        """The scale of loads: the force that stops v_q in a period [N]."""
        return self.map.system.total_mass * self.map.speed / self.map.period

    def found(self, velocity: float, load: float) -> float:
        """The mean velocity [m/s] of the steady motion, or the load [N] that blocks it.

        From a velocity and a load on. Raises NoMapError where none is found or it is not stable.
        """
        period_map = self.map
        fast_count = 3 if period_map.system.device.friction_law == 1 else 2
        swing = steady_swing(
            period_map.vibration.resonator, period_map.section, period_map.system.drive_frequency
        )
        mu = period_map.system.device.friction_coefficient
        fast = [x / s for x, s in zip((*swing, mu), period_map.scale, strict=True)]
        unknowns = [velocity / period_map.speed, *fast[:fast_count]]
        unknowns += [load / self.force] if self.blocked else []
        change, travel = self._change(unknowns)
        jacobian = self._jacobian(unknowns, change)
        for _ in range(MAX_ITERATIONS):
            step = solved(jacobian, [-c for c in change])
            largest = max(map(abs, step))
            share = min(1.0, MAX_CHANGE / largest) if largest > 0.0 else 1.0
            step = [share * s for s in step]
            unknowns = [u + s for u, s in zip(unknowns, step, strict=True)]
            expected = [(1.0 - share) * c for c in change]
            change, travel = self._change(unknowns)
            if largest <= CONVERGED:
                if self.blocked:
                    return unknowns[-1] * self.force
                if not _is_stable(self._jacobian(unknowns, change)):
                    break
                return travel / period_map.period
            # Broyden's update: what the Jacobian did not expect.
            square = sum(s * s for s in step)
            for row, c, e in zip(jacobian, change, expected, strict=True):
                for j, s in enumerate(step):
                    row[j] += (c - e) * s / square
        raise NoMapError

    def _change(self, unknowns: Vector) -> tuple[Vector, float]:
        """What a period changes, over the scales, and the travel in it [m].

        Of velocity, fast states and, for blocked motion, the position.
        """
        period_map, scale, states = self.map, self.map.scale, unknowns[1:]
        if self.blocked:
            *states, load = states
            period_map = period_map.under_load(load * self.force)
        fast = [x * s for x, s in zip(states, scale, strict=False)]
        y, u, bristle = (*fast, 0.0)[:3]
        begin = Moment(0.0, 0.0, 0.0, 0.0, psi=self.psi)
        begin = period_map.place(begin, unknowns[0] * period_map.speed, (y, u, bristle))
        (first, last), _ = period_map.sections(begin, 1, self.budget)
        slow = period_map.slow_velocity(last) - period_map.slow_velocity(first)
        parts = zip(fast_of(last), fast_of(first), scale, strict=True)
        change = [slow / period_map.speed, *((b - a) / s for b, a, s in parts)][: 1 + len(fast)]
        travel = last.position - first.position
        if self.blocked:
            change.append(travel / (period_map.speed * period_map.period))
        return change, travel

    def _jacobian(self, unknowns: Vector, change: Vector) -> Matrix:
        columns = []
        for j in range(len(unknowns)):
            beside = list(unknowns)
            beside[j] += BESIDE
            changed, _ = self._change(beside)
            columns.append([(b - c) / BESIDE for b, c in zip(changed, change, strict=True)])
        return [list(row) for row in zip(*columns, strict=True)]


def solved(matrix: Matrix, right: Vector) -> Vector:
    """The solution x of `matrix` x = `right`, by elimination with row pivots.

    Raises NoMapError for a singular matrix.
    """
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    smallest = SMALLEST_PIVOT * max(abs(x) for row in matrix for x in row)
    for k in range(len(rows)):
        pivot = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        if not smallest < abs(rows[k][k]) < inf:
            raise NoMapError
        for i in range(len(rows)):
            if i != k:
                factor = rows[i][k] / rows[k][k]
                rows[i] = [a - factor * b for a, b in zip(rows[i], rows[k], strict=True)]
    return [row[-1] / row[k] for k, row in enumerate(rows)]


def _is_stable(jacobian: Matrix) -> bool:
    """Whether the linear map of a period decays: its high powers do."""
    power = [[x + (i == j) for j, x in enumerate(row)] for i, row in enumerate(jacobian)]
    for _ in range(SQUARINGS):
        columns = list(zip(*power, strict=True))
        power = [
            [sum(a * b for a, b in zip(row, column, strict=True)) for column in columns]
            for row in power
        ]
        if not max(abs(x) for row in power for x in row) < 1e100:
            return False
    return max(abs(x) for row in power for x in row) < DECAYED
