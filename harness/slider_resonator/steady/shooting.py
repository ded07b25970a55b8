"""Steady motion as a fixed point of the map over one common period, found by shooting.

The slow velocity of table 1 has a time constant of 1140 periods, so that a run needs 16 000 periods
for an accuracy of 1e-6. The fixed point of the map over a single period is found to rounding with a
few dozen.

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

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import ceil, tau

import numpy as np
import scipy
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.references.averaged.device_average import full_friction

PeriodMap = Callable[[Array], tuple[Array, float]]
"""State (n,) at the start of a period -> state (n,) at its end, displacement over it."""

SINGULAR = 1e-9
"""Smallest over largest singular value of a Jacobian that counts as singular."""
STATE = ("velocity", "resonator_displacement", "resonator_velocity", "bristle_deflection")
"""The outputs that are states; the position does not matter, for nothing depends on it."""
WARM_UP = 20
"""Drive periods run before shooting, so that the resonator's own transient is mostly gone."""
TOLERANCE = 1e-11
"""Accuracy of the state in units of its scale, by default."""
NEUTRAL = 1e-7
"""A multiplier this close to the unit circle counts as neutral, within its error."""
DISTANCE = 1e-3
"""Distance, in units of the scale, of the neighbours that tell a kink."""

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
    function: Callable[[Array], Array], guess: Array, scale: Array, *, tolerance: float = TOLERANCE
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
        if iterations == 60:  # far more than a simple zero takes
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
        is_kept = contraction <= 0.05  # a new Jacobian would save less than it costs
    determined = np.linalg.pinv(jacobian, rcond=SINGULAR)
    for _ in range(4):  # a family of zeros may be curved
        y = y - determined @ value
        value = scaled(y)
        if residual() <= tolerance:
            break
    if residual() <= 1e-9:  # of the scale: a singular map with zeros has a family of them
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


@dataclass(frozen=True)
class FixedPoint:
    """A motion that repeats.

    `state` (n,) at the start of the period and `displacement` over it.
    `multipliers` (n,), complex, are the Floquet multipliers, largest first; `residual` is the
    largest change of the state over the period in units of the scale.
    """

    state: Array
    displacement: float
    iterations: int
    residual: float
    multipliers: NDArray[np.complex128]

    @property
    def stability(self) -> str:
        """Whether small departures decay, grow, or stay: stable, unstable or neutral."""
        largest = float(np.abs(self.multipliers).max())
        if largest > 1.0 + NEUTRAL:
            return "unstable"
        return "neutral" if largest >= 1.0 - NEUTRAL else "stable"


def fixed_point(
    period_map: PeriodMap, guess: Array, scale: Array, tolerance: float = TOLERANCE
) -> FixedPoint:
    """Find a state that the map returns to, starting from `guess` (n,); else as `solve` does."""

    def change(state: Array) -> Array:
        return period_map(state)[0] - state

    state, iterations, residual = solve(change, guess, scale, tolerance=tolerance)
    jacobian = central_jacobian(change, state, scale)
    multipliers = _multipliers(jacobian)
    sides = _one_sided_multipliers(change, state, jacobian, scale)
    if sides is not None:
        error = max(NEUTRAL, tolerance / DISTANCE)
        if min(abs(side - 1.0) for side in sides) <= error:
            raise NoPeriodicMotion("not_unique", A_FAMILY, iterations, residual)
        if abs(sides[0] - sides[1]) > 0.1 * abs(1.0 - multipliers[0]):  # a kink: the larger counts
            multipliers[0] = max(sides, key=abs)
    _, displacement = period_map(state)
    return FixedPoint(state, displacement, iterations, residual, multipliers)


def _multipliers(change_jacobian: Array) -> NDArray[np.complex128]:
    """Return the eigenvalues of the map, largest first, from the Jacobian of its change."""
    size = len(change_jacobian)
    values = np.linalg.eigvals(change_jacobian + np.eye(size)).astype(np.complex128)
    return values[np.argsort(-np.abs(values))]


def _one_sided_multipliers(
    change: Callable[[Array], Array], x: Array, jacobian: Array, scale: Array
) -> tuple[float, float] | None:
    """Return the slowest multiplier below and above the zero `x` (n,) of `change`.

    Where sliding reverses in flight, neighbouring motions may have the same friction and repeat,
    too. Such a family ends in a kink of the period map, across which the central `jacobian` (n, n)
    is meaningless. So one neighbour is followed on each side: at a given distance in the slowest
    direction, and periodic in all others. None where the slowest departure oscillates, or two
    directions are equally slow.
    """
    scaled = jacobian * scale[None, :] / scale[:, None]
    values, right = np.linalg.eig(scaled)
    slowest = int(np.argmax(np.abs(values + 1.0)))
    if values[slowest].imag != 0.0:
        return None
    found = []
    try:
        left = np.linalg.inv(right)[slowest].real
        direction = right[:, slowest].real / float(left @ right[:, slowest].real)
        border = np.block([[scaled, direction[:, None]], [left[None, :], np.zeros((1, 1))]])
        for distance in (-DISTANCE, DISTANCE):
            y = distance * direction
            for _ in range(2):  # of Newton's steps
                rest = np.append(-change(x + scale * y) / scale, distance - left @ y)
                y = y + np.linalg.solve(border, rest)[:-1]
            found.append(1.0 + float(left @ (change(x + scale * y) / scale)) / distance)
    except np.linalg.LinAlgError:
        return None
    return found[0], found[1]


class PeriodicRun(ABC):
    """A device under held inputs, run over a common period of `drive_periods`.

    Its state has the entries `names`, the velocity (m/s) first, and is sought to a `tolerance` in
    units of its scale. There are no `drive_periods` as long as no common period is known.
    """

    device: Device
    phase: float
    ratio: float
    names: tuple[str, ...]
    drive_periods: int = 0
    tolerance: float = TOLERANCE

    @property
    def drive_period(self) -> float:
        """Seconds that theta takes for one turn."""
        return tau / self.device.drive_frequency

    @property
    def period(self) -> float:
        """Length of the common period in seconds."""
        return self.drive_periods * self.drive_period

    @property
    def friction(self) -> float:
        """Mean friction force (N) of a slider that slides one way all the time."""
        return full_friction(self.device, self.phase, self.ratio)

    @abstractmethod
    def run(self, state: Array, load: float, periods: int, samples: int = 1) -> tuple[Array, Array]:
        """Return states (samples, n) and travel (samples,), in m, under a load (N).

        The run begins in a state (n,) at theta = psi = 0 and takes some drive periods, with samples
        at equal distances up to its end.
        """

    def scale(self, sizes: Array) -> Array:
        """Return the scale of each entry of the state from its largest magnitude, both (n,).

        That of a velocity is at least its change by friction in a drive period.
        """
        floor = max(self.friction / self.device.total_mass * self.drive_period, 1e-9)
        least = {"resonator_displacement": floor * self.drive_period / tau}
        scale = np.maximum(sizes, [least.get(name, floor) for name in self.names])
        if self.names[-1] == "bristle_deflection":
            scale[-1] = self.device.friction_coefficient / self.device.bristle_stiffness
        return scale

    def __call__(self, state: Array, load: float) -> tuple[Array, float]:
        """Return state (n,) and displacement (m) after a common period under a load (N)."""
        states, travel = self.run(state, load, self.drive_periods)
        return states[-1], float(travel[-1])

    def warm_up(self, velocity: float, load: float) -> tuple[Array, Array]:
        """Run some periods with the resonator at rest and the slider at `velocity` (m/s).

        Return the state (n,) after them, shifted to that mean velocity over the common period, and
        the typical size of each entry (n,) in it.
        """
        state = np.zeros(len(self.names))
        state[0] = velocity
        before = max(1, ceil(WARM_UP / self.drive_periods) - 1)  # common periods
        states, _ = self.run(state, load, before * self.drive_periods)
        states, travel = self.run(states[-1], load, self.drive_periods, 8 * self.drive_periods)
        state = states[-1].copy()
        state[0] += velocity - float(travel[-1]) / self.period
        return state, self.scale(np.abs(states).max(axis=0))


def steady_point(run: PeriodicRun, velocity: float, load: float) -> FixedPoint:
    """Find the repeating motion under a load (N), near a mean velocity (m/s) if there is one.

    Raises NoPeriodicMotion.
    """
    loaded = partial(run, load=load)
    guess, scale = run.warm_up(velocity, load)
    try:
        return fixed_point(loaded, guess, scale, run.tolerance)
    except NoPeriodicMotion:
        between = bracketed_state(loaded, guess, scale)
        if between is None:
            raise
    return fixed_point(loaded, between, scale, run.tolerance)


def blocked_point(
    run: PeriodicRun, guess: Array, scale: Array, load: float, load_scale: float
) -> tuple[float, FixedPoint]:
    """Find the load of the repeating motion without displacement over a period, near `load` (N).

    `guess` and `scale` come from a warm-up under that load, `load_scale` (N) is a typical load. One
    more unknown and one more equation than `fixed_point`: the load and displacement = 0. Raises
    NoPeriodicMotion.
    """
    displacement_scale = float(scale[0]) * run.period
    scale = np.append(scale, load_scale)

    def change(unknowns: Array) -> Array:
        state, load = unknowns[:-1], float(unknowns[-1])
        end, displacement = run(state, load)
        return np.append(end - state, displacement * load_scale / displacement_scale)

    start = np.append(guess, load)
    found, iterations, residual = solve(change, start, scale, tolerance=run.tolerance)
    multipliers = _multipliers(central_jacobian(change, found, scale)[:-1, :-1])
    state, load = found[:-1], float(found[-1])
    _, displacement = run(state, load)
    return load, FixedPoint(state, displacement, iterations, residual, multipliers)
