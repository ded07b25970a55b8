"""Steady motion as a held orbit: the velocity that a load holds.

Steady velocity and blocking force are exact: a held orbit is a periodic motion of the full device.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from math import cos, pi

from .held_orbit import (
    HeldOrbit,
    NoOrbitError,
    OrbitStatus,
    check_stable,
    held_orbit_at,
    is_same_orbit,
    steady_orbit_at,
)
from .period_map import PeriodMap

SAMPLES = 12
"""Number of velocities at which steady motion is looked for."""

MAX_HALVINGS = 60
"""Largest number of halvings between two of them."""

NOISE = 1e-9
"""Force, over full friction, within which forces balance: rounding, or the tolerance of a map."""

APART = 0.01
"""Distance in v_q of a neighbour that must not be in balance as well."""

MAX_SPEED = 1e150
"""Amplitude [m/s] of the vibration from which on squares leave the range of floating point, so that
no iteration would converge."""

SAMPLED_REACH = 1.05
"""Largest sampled velocity, in v_q: beyond grazing unless friction is strong."""


BESIDE = 0.1
"""Distance in v_q of velocities from which orbits lead to others of the velocity between them."""

FAR = 2.0
"""Velocity in v_q from which on the slider does not turn back, of further ones."""


@dataclass(slots=True)
class _Scan:
    """Result of the samples so far; forces up to `noise` [N] count as balanced.

    `low` is the highest velocity [m/s] at which friction and load accelerate the slider, while a
    bracket is open from there. Brackets hold both velocities and the orbit of a sample; samples in
    balance lie within them.
    """

    noise: float
    low: float | None = None
    brackets: list[tuple[float, float, HeldOrbit | None]] = field(default_factory=list)

    def on(self, velocity: float, excess: float, sample: HeldOrbit | None) -> None:
        """Add a sample: a velocity [m/s], the `excess` of friction and load [N], and its orbit."""
        if excess < -self.noise:
            self.low = velocity
        elif excess > self.noise and self.low is not None:
            self.brackets.append((self.low, velocity, sample))
            self.low = None


def steady_orbit(period_map: PeriodMap, lead: float, load: float) -> HeldOrbit:
    """The steady motion under `load` [N] to which motion at other velocities tends.

    Orbits at a few velocities show how many there are. Raises NoOrbitError: RUNS_AWAY for none,
    UNDETERMINED for several, UNSTABLE for one that motion leaves, NOT_CONVERGED beyond `MAX_SPEED`,
    and the reason of the last failure where no orbit was found.
    """
    if not period_map.speed < MAX_SPEED:
        raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
    sliding, reach = period_map.sliding_friction(lead), 2.0 * SAMPLED_REACH * period_map.speed
    scan, failure = _Scan(NOISE * sliding), OrbitStatus.RUNS_AWAY
    sample: HeldOrbit | None = None
    scan.on(-reach, load - sliding, sample)
    for i in range(SAMPLES):
        velocity = -SAMPLED_REACH * period_map.speed * cos(pi * (i + 0.5) / SAMPLES)
        try:
            sample = held_orbit_at(period_map, lead, velocity, sample)
        except NoOrbitError as error:
            failure, sample = error.status, None
        else:
            scan.on(velocity, load + sample.friction, sample)
    scan.on(reach, load + sliding, sample)
    if len(scan.brackets) != 1:
        raise NoOrbitError(OrbitStatus.UNDETERMINED if scan.brackets else failure)
    orbit = _refined(period_map, lead, load, *scan.brackets[0])
    if _is_neutral(period_map, orbit, load, scan.noise):
        raise NoOrbitError(OrbitStatus.UNDETERMINED)
    check_stable(period_map, orbit)
    return orbit


def blocking_force(period_map: PeriodMap, lead: float) -> float:
    """The load [N] that stops the slider. Raises NoOrbitError."""
    return -blocking_orbit(period_map, lead).friction


def blocking_orbit(period_map: PeriodMap, lead: float) -> HeldOrbit:
    """The orbit under that load. Raises NoOrbitError."""
    orbit = held_orbit_at(period_map, lead, 0.0)
    check_stable(period_map, orbit)
    return orbit


def check_unique(period_map: PeriodMap, orbit: HeldOrbit) -> None:
    """Raise NoOrbitError where neighbours on either side lead to another orbit of this velocity.

    Neighbours are `BESIDE` it and `FAR` away, where the slider does not turn back. That costs some
    90 maps; under weak friction there is one orbit.
    """
    speed, velocity = period_map.speed, orbit.velocity
    beside = (velocity - BESIDE * speed, velocity + BESIDE * speed)
    for start in (*beside, -FAR * speed, FAR * speed):
        try:
            neighbour = held_orbit_at(period_map, orbit.lead, start)
            other = held_orbit_at(period_map, orbit.lead, velocity, neighbour)
        except NoOrbitError:
            continue
        if not is_same_orbit(period_map, orbit, other):
            raise NoOrbitError(OrbitStatus.UNDETERMINED)


def _is_neutral(period_map: PeriodMap, orbit: HeldOrbit, load: float, noise: float) -> bool:
    """Whether the orbit is one of a family that all hold the load: none is the steady one."""
    for side in (-1.0, 1.0):
        velocity = orbit.velocity + side * APART * period_map.speed
        try:
            neighbour = held_orbit_at(period_map, orbit.lead, velocity, orbit)
        except NoOrbitError:
            continue
        if abs(neighbour.friction + load) <= noise:
            return True
    return False


def _refined(
    period_map: PeriodMap,
    lead: float,
    load: float,
    low: float,
    high: float,
    sample: HeldOrbit | None,
) -> HeldOrbit:
    """The steady motion between two velocities: Newton's method, with bisection as a fallback."""
    for _ in range(MAX_HALVINGS):
        try:
            orbit = steady_orbit_at(period_map, lead, load, sample)
            if low <= orbit.velocity <= high:
                return orbit
        except NoOrbitError:
            pass
        middle = 0.5 * (low + high)
        sample = held_orbit_at(period_map, lead, middle, sample)
        low, high = (low, middle) if sample.friction + load > 0.0 else (middle, high)
    raise NoOrbitError(OrbitStatus.NOT_CONVERGED)
