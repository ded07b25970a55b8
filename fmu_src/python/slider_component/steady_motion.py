"""Periodic motion of the full device as a fixed point of the period map.

Steady motion is one under the given load, blocked motion one without travel under a load that is
looked for. Newton's method finds both, from first-order averages on.
"""

from math import inf
from typing import NamedTuple

from .budget import MAX_SEGMENTS, Budget
from .moment import Moment
from .period_map import NoMapError, PeriodMap

Vector = list[float]
Matrix = list[Vector]

BESIDE = 1e-6
"""Change of an unknown by which derivatives are taken; unknowns are over their scales."""

MAX_CHANGE = 0.2
"""Largest change of an unknown in an iteration."""

CONVERGED = 1e-10
"""Change at which the iteration ends: the next one would be rounding."""

MAX_ITERATIONS = 24
REDUCED = 0.5
"""Share of the excess that an iteration must leave at most; above it the derivatives are taken
anew, as where a reversal has become a stick."""

LEAD_IN = 2
"""Periods by which the start of a search is followed where friction may change V by more than an
iteration: it brings near what is looked for."""

SHARE_OF_STEP = 0.1
"""Share of the work of a step that a search may take: a host that reads an output does not expect
to wait."""

SMALLEST_PIVOT = 1e-13
"""Smallest pivot that counts as different from 0, over the largest entry of a matrix."""
SQUARINGS = 24
DECAYED = 0.5
"""Squarings of the linear map after which it must have decayed: in 2^24 periods, more than rounding
of its derivatives could make it."""


class Change(NamedTuple):
    """What a period of a motion changes.

    `excess` is what periodic motion has none of, over the scales: of the position only in blocked
    motion, otherwise what the load is beyond the given one. `travel` [m] and `reversals` count.
    """

    excess: Vector
    travel: float
    reversals: int


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

        From a velocity on. Raises NoMapError where none is found, where it is not stable, and where
        the blocked slider never reverses: it sticks, under other loads, too.
        """
        unknowns = self._led_in(velocity)
        change = self._change(unknowns)
        jacobian = self._jacobian(unknowns, change.excess)
        for _ in range(MAX_ITERATIONS):
            before = change.excess
            step = solved(jacobian, [-e for e in before])
            largest = max(map(abs, step))
            share = min(1.0, MAX_CHANGE / largest) if largest > 0.0 else 1.0
            step = [share * s for s in step]
            unknowns = [u + s for u, s in zip(unknowns, step, strict=True)]
            change = self._change(unknowns)
            if largest <= CONVERGED:
                return self._answer(unknowns, change)
            if max(map(abs, change.excess)) > REDUCED * max(map(abs, before)):
                jacobian = self._jacobian(unknowns, change.excess)
                continue
            # Broyden's update: what the Jacobian did not expect.
            square = sum(s * s for s in step)
            for row, new, old in zip(jacobian, change.excess, before, strict=True):
                for j, s in enumerate(step):
                    row[j] += (new - (1.0 - share) * old) * s / square
        raise NoMapError

    def _led_in(self, velocity: float) -> Vector:
        """The unknowns from a slow velocity [m/s] and the steady vibration without friction on.

        Under strong friction after some periods, without their travel where motion is blocked.
        """
        period_map, device = self._map, self._map.motion.system.device
        swing = period_map.vibration.swing(period_map.section)
        bristle = device.friction_coefficient if device.friction_law == 1 else 0.0
        fast = [x / s for x, s in zip((*swing, bristle), self._scale[2:], strict=True)]
        unknowns = [velocity / period_map.speed, self._load, *fast]
        for _ in range(LEAD_IN if period_map.share > MAX_CHANGE else 0):
            first, travelled, *others = self._change(unknowns).excess
            if not self._blocked:
                travelled = 0.0
            steps = [first - travelled, 0.0, *others]
            unknowns = [u + s for u, s in zip(unknowns, steps, strict=True)]
        return unknowns

    def _answer(self, unknowns: Vector, change: Change) -> float:
        if self._blocked:
            if change.reversals == 0:
                raise NoMapError
            return unknowns[1] * self._scale[1]
        if not _is_stable(self._jacobian(unknowns, change.excess)):
            raise NoMapError
        return change.travel / self._map.period

    def _change(self, unknowns: Vector) -> Change:
        velocity, load, *fast = (u * s for u, s in zip(unknowns, self._scale, strict=True))
        period_map = self._map.under_load(load)
        begin = period_map.place(Moment(0.0, 0.0, 0.0, 0.0, psi=self._psi), velocity, fast)
        sections, _ = period_map.sections(begin, 1, self._budget)
        first, last = map(period_map.numbers, sections)
        excess = [(b - a) / s for a, b, s in zip(first, last, period_map.scale, strict=True)]
        if not self._blocked:
            excess[1] = self._load - unknowns[1]
        if period_map.motion.system.device.friction_law == 0:
            excess[-1] = -unknowns[-1]
        return Change(excess, last[1], sections[-1].reversals - sections[0].reversals)

    def _jacobian(self, unknowns: Vector, excess: Vector) -> Matrix:
        columns = []
        for j in range(len(unknowns)):
            beside = list(unknowns)
            beside[j] += BESIDE
            changed = self._change(beside).excess
            columns.append([(b - e) / BESIDE for b, e in zip(changed, excess, strict=True)])
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
