"""Periodic motion of the full device as a fixed point of the period map, by Newton's method.

Steady motion is one under the given load, blocked motion one without travel under a load that is
looked for.
"""

from math import inf

from .budget import MAX_SEGMENTS, Budget
from .moment import Moment
from .period_map import PeriodMap
from .slow_equation import NoRatesError

Vector = list[float]
Matrix = list[Vector]

BESIDE = 1e-6
"""Change of an unknown by which derivatives are taken; unknowns are over their scales."""

MAX_CHANGE = 0.2
"""Largest change of an unknown in an iteration."""

NEAR = 1e-3
"""Change from which on the last derivatives serve to the end."""

CONVERGED = 1e-10
"""Change at which the iteration ends: the next one would be rounding."""

MAX_ITERATIONS = 24

LEAD_IN = 2
"""Periods of motion before a search: they bring near what is looked for, under strong friction."""

SHARE_OF_STEP = 0.1
"""Share of the work of a step that a search may take: a host that reads an output does not expect
to wait."""

SMALLEST_PIVOT = 1e-13
"""Smallest pivot that counts as different from 0, over the largest entry of a matrix."""

SQUARINGS = 24
DECAYED = 0.5
"""Squarings of the linear map after which it must have decayed: in 2^24 periods, more than rounding
of its derivatives could make it."""


class PeriodicMotion:
    """A periodic motion that is looked for, at normal phase `psi` [rad] at the section.

    Unknowns are the slow velocity, the load and the fast states, all over their scales. Periodic
    motion is free under a given load, or else `blocked`: without travel. All maps of the search
    draw from one budget.
    """

    def __init__(self, period_map: PeriodMap, psi: float, load: float, blocked: bool) -> None:
        self._map, self._psi, self._blocked = period_map, psi, blocked
        self._budget = Budget(period_map.period, int(SHARE_OF_STEP * MAX_SEGMENTS))
        # The force that stops v_q in a period [N].
        force = period_map.motion.system.total_mass * period_map.speed / period_map.period
        speed, _, *fast = period_map.scale
        self._scale, self._load = [speed, force, *fast], load / force

    def found(self, velocity: float) -> float:
        """The mean velocity [m/s] of the steady motion, or the load [N] that blocks it.

        From a slow velocity [m/s] and the steady vibration without friction on. Raises NoRatesError
        where none is found, where it is not stable, and where the blocked slider never reverses:
        it sticks, under other loads, too.
        """
        period_map, device = self._map, self._map.motion.system.device
        swing = period_map.vibration.swing(period_map.section)
        bristle = device.friction_coefficient if device.friction_law == 1 else 0.0
        fast = [x / s for x, s in zip((*swing, bristle), self._scale[2:], strict=True)]
        unknowns = [velocity / period_map.speed, self._load, *fast]
        for _ in range(LEAD_IN):
            (first, travelled, *others), _ = self._excess(unknowns)
            changes = [first - travelled * self._blocked, 0.0, *others]
            unknowns = [u + c for u, c in zip(unknowns, changes, strict=True)]
        largest = inf
        for _ in range(MAX_ITERATIONS):
            excess, end = self._excess(unknowns)
            if largest <= CONVERGED:
                break
            if largest > NEAR:
                jacobian = self._jacobian(unknowns, excess)
            step = solved(jacobian, [-e for e in excess])
            largest = max(map(abs, step))
            share = min(1.0, MAX_CHANGE / largest) if largest > 0.0 else 1.0
            unknowns = [u + share * s for u, s in zip(unknowns, step, strict=True)]
        else:
            raise NoRatesError
        if not self._blocked and _is_stable(jacobian):
            return end.position / period_map.period
        if self._blocked and end.reversals > 0:
            return unknowns[1] * self._scale[1]
        raise NoRatesError

    def _excess(self, unknowns: Vector) -> tuple[Vector, Moment]:
        """What a period changes that periodic motion leaves, over the scales; and its end.

        The position counts in blocked motion only, otherwise what the load is beyond the given one.
        """
        velocity, load, *fast = (u * s for u, s in zip(unknowns, self._scale, strict=True))
        period_map = self._map.under_load(load)
        begin = period_map.place(Moment(0.0, 0.0, 0.0, 0.0, psi=self._psi), velocity, fast)
        (_, end), _ = period_map.sections(begin, 1, self._budget)
        first, last = period_map.numbers(begin), period_map.numbers(end)
        excess = [(b - a) / s for a, b, s in zip(first, last, period_map.scale, strict=True)]
        if not self._blocked:
            excess[1] = self._load - unknowns[1]
        if period_map.motion.system.device.friction_law == 0:
            excess[-1] = -unknowns[-1]
        return excess, end

    def _jacobian(self, unknowns: Vector, excess: Vector) -> Matrix:
        columns = []
        for j in range(len(unknowns)):
            beside = list(unknowns)
            beside[j] += BESIDE
            changed, _ = self._excess(beside)
            columns.append([(b - e) / BESIDE for b, e in zip(changed, excess, strict=True)])
        return [list(row) for row in zip(*columns, strict=True)]


def solved(matrix: Matrix, right: Vector) -> Vector:
    """The solution x of `matrix` x = `right`, by elimination with row pivots.

    Raises NoRatesError for a singular matrix.
    """
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    smallest = SMALLEST_PIVOT * max(abs(x) for row in matrix for x in row)
    for k in range(len(rows)):
        pivot = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        if not smallest < abs(rows[k][k]) < inf:
            raise NoRatesError
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
