"""Zeros and fixed points of functions that are expensive and exact to rounding.

By damped Newton iteration: progress is judged by the size of the next correction, not by the
residual (Deuflhard's natural monotonicity test). That does not depend on the scaling of rows and
columns, which matters where one direction is a thousand times softer than the others. A Jacobian
that still contracts fast is kept, because a new one costs 2 n evaluations.

Where that fails, by bracketing. Friction opposes motion, so the slow state, entry 0, grows over a
period when it is far below the fixed point and falls when it is far above. The other entries are
fast: those of the resonator, whose response is almost linear, and that of the bristle, whose memory
is short. For every value of entry 0 Newton's iteration makes the fast entries repeat. One equation
in one unknown remains, whose sign changes between the bounds.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy

from slider_resonator.arrays import Array

PeriodMap = Callable[[Array], tuple[Array, float]]
"""State (n,) at the start of a period -> state (n,) at its end, displacement over it."""

DIFFERENCE = 1e-4
"""Steps of a Jacobian, in units of the scale."""
MAX_ITERATIONS = 60
SINGULAR = 1e-9
"""Smallest over largest singular value of a Jacobian that counts as singular."""
SINGULAR_STEPS = 4
"""Last steps with a singular Jacobian: a family of zeros may be curved."""
KEEP = 0.05
"""Largest ratio of successive corrections for which the Jacobian is kept."""
DAMPINGS = tuple(2.0**-halvings for halvings in range(9))
"""Shares of a correction that are tried, in this order."""
ROUNDING = 100.0
"""Correction, in tolerances, that is accepted when it no longer decreases, by rounding."""
FLAT = 1e-7
"""Residual over correction, in units of the scale, up to which a Jacobian counts as singular where
no step brings the zero closer: all that is left is rounding."""
FAMILY = 1e-9
"""Residual, in units of the scale, below which a singular map has a family of fixed points."""

A_FAMILY = (
    "a whole family of motions repeats: friction does not choose among them, each start keeps its "
    "own velocity"
)


@dataclass(eq=False)
class NoPeriodicMotion(Exception):
    """No repeating motion was found: `status` for machines, `reason` with a remedy for people.

    `iterations` were made, after which the state changes by `residual` over a period, in units of
    its scale; None where nothing was run.
    """

    status: str
    reason: str
    iterations: int = 0
    residual: float | None = None


@dataclass(frozen=True)
class Root:
    """A zero `x` (n,); `residual` is the largest function value left, in units of the scale."""

    x: Array
    iterations: int
    residual: float
    inverse: Array
    """Inverse of the scaled Jacobian (n, n)."""


def central_jacobian(function: Callable[[Array], Array], x: Array, scale: Array) -> Array:
    """Return the Jacobian (n, n) at `x` by central differences; `scale` (n,) is that of `x`.

    Central, because their error is of second order in a step that must stay well above rounding.
    """
    steps = DIFFERENCE * scale
    changes = [function(x + shift) - function(x - shift) for shift in np.diag(steps)]
    return np.column_stack(changes) / (2.0 * steps)


def solve(
    function: Callable[[Array], Array],
    guess: Array,
    scale: Array,
    *,
    tolerance: float = 1e-11,
    inverse: Array | None = None,
) -> Root:
    """Find a zero of `function`, (n,) -> (n,) and finite, the change of a state over a period.

    The search starts at `guess` (n,). `scale` (n,) is the typical size of each unknown and of the
    function value beside it; `tolerance` bounds the last correction, in units of it. The `inverse`
    of a zero nearby is tried first. Raises NoPeriodicMotion where there is no zero, or none can be
    singled out. With a singular Jacobian some more steps are taken in the directions that it
    determines: a residual that vanishes then shows a family of zeros, one that remains shows that
    there is none.
    """

    def scaled(y: Array) -> Array:
        return function(y * scale) / scale

    def residual() -> float:
        return float(np.abs(value).max())

    def unconverged(why: str) -> NoPeriodicMotion:
        reason = (
            f"did not converge ({why}): after {iterations} iterations the next correction is "
            f"{size:.3g} of the scale, the change over a period {residual():.3g}"
        )
        return NoPeriodicMotion("not_converged", reason, iterations, residual())

    y = guess / scale
    iterations = 0
    value = scaled(y)
    is_kept = inverse is not None
    while True:
        if inverse is None or not is_kept:
            jacobian = central_jacobian(scaled, y, np.ones_like(y))
            sizes = np.linalg.svd(jacobian, compute_uv=False)
            if sizes[-1] <= SINGULAR * sizes[0]:
                break
            inverse = np.asarray(np.linalg.inv(jacobian), dtype=np.float64)
        correction = -inverse @ value
        size = float(np.linalg.norm(correction))
        if size <= tolerance:
            return Root(y * scale, iterations, residual(), inverse)
        if iterations == MAX_ITERATIONS:
            raise unconverged("out of iterations")
        iterations += 1
        for damping in DAMPINGS:
            trial = y + damping * correction
            trial_value = scaled(trial)
            contraction = float(np.linalg.norm(inverse @ trial_value)) / size
            if contraction <= 1.0 - damping / 4.0:
                y, value = trial, trial_value
                break
            if size <= ROUNDING * tolerance:
                return Root(y * scale, iterations, residual(), inverse)
        else:  # a new Jacobian may bring it closer, or rounding alone is left
            if not is_kept and residual() > FLAT * size:
                raise unconverged("no step brings it closer")
            if not is_kept:
                break
        is_kept = contraction <= KEEP
    determined = np.linalg.pinv(jacobian, rcond=SINGULAR)
    for _ in range(SINGULAR_STEPS):
        y = y - determined @ value
        value = scaled(y)
        if residual() <= tolerance:
            break
    if residual() <= FAMILY:
        raise NoPeriodicMotion("not_unique", A_FAMILY, iterations, residual())
    drifts = f"the state drifts by {residual():.3g} of its scale in every period: no motion repeats"
    raise NoPeriodicMotion("no_fixed_point", drifts, iterations, residual())


DOUBLINGS = 6
"""Maximum doublings of the bounds, which begin at the scale of the slow state."""
EXACT = 1e-14
"""Last correction, in units of the scale, of fast states that are found to rounding."""


def bracketed_state(period_map: PeriodMap, guess: Array, scale: Array) -> Array | None:
    """Return a state (n,) that the map returns to, near enough for Newton, or None.

    `guess` (n,) starts the fast entries, `scale` (n,) is the typical size of each entry.
    """
    state, inverse = guess.copy(), None

    def fast_change(fast: Array) -> Array:
        return period_map(np.append(state[0], fast))[0][1:] - fast

    def slow_change(slow: float) -> float:
        """Return the change of entry 0; leaves in `state` the state that it belongs to."""
        nonlocal inverse
        state[0] = slow
        if len(state) > 1:
            fast = solve(fast_change, state[1:], scale[1:], tolerance=EXACT, inverse=inverse)
            state[1:], inverse = fast.x, fast.inverse
        return float(period_map(state)[0][0]) - slow

    try:
        for doubling in range(DOUBLINGS):
            bound = float(scale[0]) * 2.0**doubling
            if slow_change(-bound) > 0.0 > slow_change(bound):
                slow_change(scipy.optimize.brentq(slow_change, -bound, bound, xtol=1e-10 * bound))
                return state
    except (NoPeriodicMotion, ValueError):  # by rounding the bounds may change sides
        pass
    return None
