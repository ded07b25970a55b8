"""Find a fixed point of a period map between two bounds, where Newton's method alone fails.

Friction opposes motion, so the slow state, entry 0, grows over a period when it is far below the
fixed point and falls when it is far above. The other entries are fast: those of the resonator,
whose response is almost linear, and that of the bristle, whose memory is short. For every value of
entry 0 a Newton iteration with a Jacobian that is seldom renewed makes the fast entries repeat. One
equation in one unknown remains, whose sign changes between the bounds.
"""

import numpy as np
import scipy

from slider_resonator.steady.newton import DIFFERENCE, Matrix, PeriodMap, Vector, central_jacobian

DOUBLINGS = 6
"""Maximum doublings of the bounds, which begin at the scale of the slow state."""
INNER_ITERATIONS = 50
SLOW = 0.5
"""Largest ratio of successive changes of the fast states for which the Jacobian is kept."""
INNER_TOLERANCE = 1e-13
"""Remaining change of the fast states over a period, in units of their scale."""


class _NoBracketError(Exception):
    """The map does not have the sign change or the contraction that this method needs."""


def bracketed_state(period_map: PeriodMap, guess: Vector, scale: Vector) -> Vector | None:
    """Return a state (n,) that the map returns to, near enough for Newton, or None.

    `guess` (n,) starts the fast entries, `scale` (n,) is the typical size of each entry.
    """
    state, inverse = guess.copy(), np.empty((0, 0))

    def inverse_jacobian() -> Matrix:
        """Return the inverse of the Jacobian of the fast states' change, at the present state."""
        if len(state) == 1:
            return inverse

        def fast_change(fast: Vector) -> Vector:
            return period_map(np.append(state[0], fast))[0][1:] - fast

        jacobian = central_jacobian(fast_change, state[1:], DIFFERENCE * scale[1:])
        return np.asarray(np.linalg.inv(jacobian), dtype=np.float64)

    def slow_change(slow: float) -> float:
        """Return the change of entry 0; leaves in `state` the state that it belongs to."""
        nonlocal inverse
        state[0], before = slow, np.inf
        for _ in range(INNER_ITERATIONS):
            change = period_map(state)[0] - state
            size = float(np.abs(change[1:] / scale[1:]).max(initial=0.0))
            if size <= INNER_TOLERANCE:
                return float(change[0])
            if size > SLOW * before:
                inverse = inverse_jacobian()
            before = size
            state[1:] -= inverse @ change[1:]
        raise _NoBracketError

    try:
        inverse = inverse_jacobian()
        for doubling in range(DOUBLINGS):
            bound = float(scale[0]) * 2.0**doubling
            if slow_change(-bound) > 0.0 > slow_change(bound):
                slow_change(scipy.optimize.brentq(slow_change, -bound, bound, xtol=1e-14 * bound))
                return state
    except (_NoBracketError, np.linalg.LinAlgError):
        pass
    return None
