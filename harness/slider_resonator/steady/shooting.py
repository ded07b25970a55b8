"""Steady motion as a fixed point of the map over one common period, found by shooting.

The slow velocity of table 1 has a time constant of 1140 periods, so that a run needs 16 000 periods
for an accuracy of 1e-6. The fixed point of the map over a single period is found to rounding with a
few dozen.
"""

from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass
from functools import partial
from math import ceil, tau

import numpy as np
from numpy.typing import NDArray

from slider_resonator.arrays import Array
from slider_resonator.device.device import Device
from slider_resonator.references.averaged.device_average import full_friction
from slider_resonator.steady.solvers import (
    A_FAMILY,
    NoPeriodicMotion,
    PeriodMap,
    bracketed_state,
    central_jacobian,
    solve,
)

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
        if abs(sides[0] - sides[1]) > 0.1 * abs(1.0 - multipliers[0]):  # a kink
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
