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

SINGULAR = 1e-9
"""Smallest over largest singular value of a Jacobian that counts as singular."""

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


def central_jacobian(function: Callable[[Array], Array], x: Array, scale: Array) -> Array:
    """Return the Jacobian (n, n) at `x` by central differences; `scale` (n,) is that of `x`.

    Central, because their error is of second order in a step that must stay well above rounding.
    """
    steps = 1e-4 * scale
    changes = [function(x + shift) - function(x - shift) for shift in np.diag(steps)]
    return np.column_stack(changes) / (2.0 * steps)


def solve(
    function: Callable[[Array], Array], guess: Array, scale: Array, *, tolerance: float = 1e-11
) -> tuple[Array, int, float]:
    """Find a zero of `function`, (n,) -> (n,) and finite, the change of a state over a period.

    Return it with the number of iterations and the largest function value left, in units of the
    scale. The search starts at `guess` (n,). `scale` (n,) is the typical size of each unknown and
    of the function value beside it; `tolerance` bounds the last correction, in units of it. Raises
    NoPeriodicMotion where there is no zero, or none can be singled out. With a singular Jacobian
    some more steps are taken in the directions that it determines: a residual that vanishes then
    shows a family of zeros, one that remains shows that there is none.
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
    is_kept = False
    while True:
        if not is_kept:
            jacobian = central_jacobian(scaled, y, np.ones_like(y))
            sizes = np.linalg.svd(jacobian, compute_uv=False)
            if sizes[-1] <= SINGULAR * sizes[0]:
                break
            inverse = np.linalg.inv(jacobian)
        correction = -inverse @ value
        size = float(np.linalg.norm(correction))
        if size <= tolerance:
            return y * scale, iterations, residual()
        if iterations == 60:
            raise unconverged("out of iterations")
        iterations += 1
        for damping in 0.5 ** np.arange(9):
            trial = y + damping * correction
            trial_value = scaled(trial)
            contraction = float(np.linalg.norm(inverse @ trial_value)) / size
            if contraction <= 1.0 - damping / 4.0:
                y, value = trial, trial_value
                break
            if size <= 100.0 * tolerance:  # it no longer decreases, by rounding
                return y * scale, iterations, residual()
        else:  # a new Jacobian may bring it closer, or rounding alone is left
            if not is_kept and residual() > 1e-7 * size:
                raise unconverged("no step brings it closer")
            if not is_kept:
                break
        is_kept = contraction <= 0.05
    determined = np.linalg.pinv(jacobian, rcond=SINGULAR)
    for _ in range(4):  # a family of zeros may be curved
        y = y - determined @ value
        value = scaled(y)
        if residual() <= tolerance:
            break
    if residual() <= 1e-9:
        raise NoPeriodicMotion("not_unique", A_FAMILY, iterations, residual())
    drifts = f"the state drifts by {residual():.3g} of its scale in every period: no motion repeats"
    raise NoPeriodicMotion("no_fixed_point", drifts, iterations, residual())


def bracketed_state(period_map: PeriodMap, guess: Array, scale: Array) -> Array | None:
    """Return a state (n,) that the map returns to, near enough for Newton, or None.

    `guess` (n,) starts the fast entries, `scale` (n,) is the typical size of each entry.
    """
    state = guess.copy()

    def fast_change(fast: Array) -> Array:
        return period_map(np.append(state[0], fast))[0][1:] - fast

    def slow_change(slow: float) -> float:
        """Return the change of entry 0; leaves in `state` the state that it belongs to."""
        state[0] = slow
        if len(state) > 1:
            state[1:] = solve(fast_change, state[1:], scale[1:], tolerance=1e-14)[0]
        return float(period_map(state)[0][0]) - slow

    try:
        for bound in (float(scale[0]) * 2.0 ** np.arange(6)).tolist():
            if slow_change(-bound) > 0.0 > slow_change(bound):
                slow_change(scipy.optimize.brentq(slow_change, -bound, bound, xtol=1e-10 * bound))
                return state
    except (NoPeriodicMotion, ValueError):  # by rounding the bounds may change sides
        pass
    return None
