"""Find a fixed point of a period map between two bounds, where Newton's method alone fails.

Friction opposes motion, so the slow state, entry 0, grows over a period when it is far below the
fixed point and falls when it is far above. The other entries are fast: those of the resonator,
whose response is almost linear, and that of the bristle, whose memory is short. For every value of
entry 0 a Newton iteration with a Jacobian that is seldom renewed makes the fast entries repeat. One
equation in one unknown remains, whose sign changes between the bounds.
"""

from __future__ import annotations

import numpy as np
import scipy

from slider_resonator.steady.newton import DIFFERENCE, Matrix, Vector, central_jacobian
from slider_resonator.steady.shooting import PeriodMap

DOUBLINGS = 6
"""Maximum doublings of the bounds, which begin at the scale of the slow state."""
INNER_ITERATIONS = 50
SLOW = 0.5
"""Largest ratio of successive changes of the fast states for which the Jacobian is kept."""
INNER_TOLERANCE = 1e-13
"""Remaining change of the fast states over a period, in units of their scale."""


class _NoBracket(Exception):
    """The map does not have the sign change or the contraction that this method needs."""


def bracketed_state(period_map: PeriodMap, guess: Vector, scale: Vector) -> Vector | None:
    """Return a state (n,) that the map returns to, near enough for Newton, or None.

    `guess` (n,) starts the fast entries, `scale` (n,) is the typical size of each entry.
    """
    try:
        return _Elimination(period_map, guess, scale).root()
    except _NoBracket:
        return None


class _Elimination:
    """The change of the slow state over a period in which the fast states repeat."""

    def __init__(self, period_map: PeriodMap, guess: Vector, scale: Vector) -> None:
        self.period_map = period_map
        self.scale = scale
        self.state = guess.copy()
        self.inverse = self._inverse()

    def root(self) -> Vector:
        bound = float(self.scale[0])
        for _ in range(DOUBLINGS):
            if self.slow_change(-bound) > 0.0 > self.slow_change(bound):
                break
            bound *= 2.0
        else:
            raise _NoBracket
        slow = scipy.optimize.brentq(self.slow_change, -bound, bound, xtol=1e-14 * bound)
        self.slow_change(slow)
        return self.state

    def slow_change(self, slow: float) -> float:
        """Return the change of entry 0; leaves in `state` the state that it belongs to."""
        self.state[0] = slow
        before = np.inf
        for _ in range(INNER_ITERATIONS):
            end, _ = self.period_map(self.state)
            change = end - self.state
            size = float(np.abs(change[1:] / self.scale[1:]).max(initial=0.0))
            if size <= INNER_TOLERANCE:
                return float(change[0])
            if size > SLOW * before:
                self.inverse = self._inverse()
            before = size
            self.state[1:] -= self.inverse @ change[1:]
        raise _NoBracket

    def _inverse(self) -> Matrix:
        """Return the inverse of the Jacobian of the fast states' change, at the present state."""
        slow, fast = self.state[0], self.state[1:]
        if not fast.size:
            return np.empty((0, 0))

        def fast_change(fast: Vector) -> Vector:
            end, _ = self.period_map(np.append(slow, fast))
            return end[1:] - fast

        jacobian = central_jacobian(fast_change, fast, DIFFERENCE * self.scale[1:])
        try:
            return np.asarray(np.linalg.inv(jacobian), dtype=np.float64)
        except np.linalg.LinAlgError as error:
            raise _NoBracket from error
