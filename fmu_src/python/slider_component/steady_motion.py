"""Periodic motion of the full device as a fixed point of the period map, by Newton's method."""

from collections.abc import Sequence
from math import inf
from operator import mul

from .moment import Moment
from .period_map import PeriodMap
from .slow_equation import NoRatesError
from .values import MAX_SEGMENTS, Budget

Vector = list[float]
Matrix = Sequence[Sequence[float]]

BESIDE = 1e-6
"""Change of an unknown by which derivatives are taken; unknowns are over their scales."""

MAX_CHANGE = 0.2
"""Largest change of an unknown in an iteration."""

NEAR = 1e-3
"""Change from which on the last derivatives serve to the end."""

CONVERGED = 1e-10
"""Change at which the iteration ends: the next one would be rounding."""

MAX_ITERATIONS = 24

SHARE_OF_STEP = 0.1
"""Share of the work of a step that a search may take: a host that reads an output does not expect
to wait."""

SQUARINGS = 24
"""Squarings of the linear map after which it must have halved: in 2^24 periods, more than rounding
of its derivatives could make it."""


def periodic_motion(
    period_map: PeriodMap, psi: float, velocity: float, load: float, blocked: bool
) -> float:
    """The mean velocity [m/s] of the steady motion under a load [N], or the load that blocks it.

    Blocked motion has no travel; the given load is a guess. The search begins at a slow velocity
    [m/s], the steady vibration without friction, and normal phase `psi` [rad] at the section. All
    its maps draw from one budget. Raises NoRatesError where none is found, where it is not stable,
    and where the blocked slider never reverses: it sticks, under other loads, too.
    """
    device, speed = period_map.motion.system.device, period_map.speed
    budget = Budget(period_map.period, 0.0, int(SHARE_OF_STEP * MAX_SEGMENTS))
    vibrating = Moment(0.0, *period_map.vibration.swing(period_map.section), 0.0, psi=psi)
    vibrating.bristle = device.friction_coefficient
    _, *fast, _ = period_map.numbers(vibrating)
    # The slow velocity, the fast states and, if unknown, the load, by the force that stops v_q in a
    # period. A period of periodic motion changes none of the former, nor, if blocked, the position.
    force = device.total_mass * speed / period_map.period
    scales = [*period_map.scale[:-1], force]
    start = [velocity, *fast, *([load] if blocked else [])]
    unknowns = [x / s for x, s in zip(start, scales, strict=False)]

    def changes(unknowns: Vector) -> tuple[Vector, Moment]:
        """What a period changes, over the scales, and its end."""
        slow, *fast = (u * s for u, s in zip(unknowns, scales, strict=False))
        loaded = period_map.under_load(fast.pop() if blocked else load)
        begin = loaded.place(vibrating, slow, fast)
        (_, end), _ = loaded.sections(begin, 1, budget)
        first, last = loaded.numbers(begin), loaded.numbers(end)
        changed = [(b - a) / s for a, b, s in zip(first, last, period_map.scale, strict=True)]
        return changed if blocked else changed[:-1], end

    # Two periods of motion bring near what is looked for, under strong friction.
    for _ in range(2):
        changed, _ = changes(unknowns)
        if blocked:
            changed[0], changed[-1] = changed[0] - changed[-1], 0.0
        unknowns = [u + c for u, c in zip(unknowns, changed, strict=True)]
    largest = inf
    for _ in range(MAX_ITERATIONS):
        now, end = changes(unknowns)
        if largest > NEAR:
            columns = []
            for j in range(len(unknowns)):
                beside = [u + BESIDE * (i == j) for i, u in enumerate(unknowns)]
                differences = zip(changes(beside)[0], now, strict=True)
                columns.append([(b - a) / BESIDE for b, a in differences])
            jacobian = list(zip(*columns, strict=True))
        elif largest <= CONVERGED and blocked and end.reversals > 0:
            return unknowns[-1] * force
        elif largest <= CONVERGED and not blocked and _is_stable(jacobian):
            return end.position / period_map.period
        step = solved(jacobian, [-e for e in now])
        largest = max(map(abs, step))
        share = min(1.0, MAX_CHANGE / largest) if largest > 0.0 else 1.0
        unknowns = [u + share * s for u, s in zip(unknowns, step, strict=True)]
    raise NoRatesError


def solved(matrix: Matrix, right: Vector) -> Vector:
    """The solution x of `matrix` x = `right`, by elimination with row pivots.

    Raises NoRatesError for a singular matrix.
    """
    rows = [[*row, value] for row, value in zip(matrix, right, strict=True)]
    for k in range(len(rows)):
        pivot = max(range(k, len(rows)), key=lambda i: abs(rows[i][k]))
        rows[k], rows[pivot] = rows[pivot], rows[k]
        if not 0.0 < abs(rows[k][k]) < inf:
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
        power = [[sum(map(mul, row, c)) for c in zip(*power, strict=True)] for row in power]
    return all(abs(x) < 0.5 for row in power for x in row)
