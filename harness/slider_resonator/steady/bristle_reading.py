"""The deflection of the LuGre bristle at the end of a period, inferred from the outputs.

Friction is F = faces N (s0 z + s1 (v - |v| s0 z / mu)), (8), so z follows from the outputs wherever
the contact is closed and the bracket depends on z. Where that fails at the end of the period, z is
read shortly before and followed along the path, on which alone its change depends.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from math import asin, copysign, expm1, pi, sin, sqrt, tau

import numpy as np
import scipy

from slider_resonator.arrays import Array
from slider_resonator.errors import FmuError

CLEAR = 0.01
"""Minimum weight of the deflection in the friction force, as a share of full weight."""
TOUCHING = 1e-6
"""Smallest normal force, in units of its largest, of a contact that counts as closed."""
LEAD = 1.0 / 16.0
"""Part of a turn that is read before the end, or before the last lift-off."""
POINTS = 64
"""Readings in a turn of the fastest oscillation: four give a reversal between them to rounding."""
MAX_POINTS = 1024


@dataclass(frozen=True)
class BristleReading:
    """Data for reading z: mu > 0, s0 > 0 (1/m), s1 (s/m), faces, and times before the end.

    `leads` (s) descend to 0: the times before the end of the period at which to read.
    """

    coefficient: float
    stiffness: float
    damping: float
    faces: float
    leads: tuple[float, ...]

    @property
    def scale(self) -> float:
        """Deflection (m) of a fully bent bristle."""
        return self.coefficient / self.stiffness

    def deflection(
        self, times: Array, position: Array, velocity: Array, friction: Array, normal: Array
    ) -> float:
        """Return z (m) at the last of the times, all shape (n,), SI units.

        Raises FmuError where no reading shows it.
        """
        weight = np.where(normal > 0.0, 1.0 - self.damping * np.abs(velocity) / self.coefficient, 0)
        clear = np.flatnonzero(np.abs(weight) >= CLEAR)
        last = int(clear[-1]) if clear.size else int(np.argmax(np.abs(weight)))
        if weight[last] == 0.0:
            raise FmuError(
                f"the bristle deflection cannot be read: from t = {times[0]:.9g} to "
                f"{times[-1]:.9g} s friction_force does not depend on it"
            )
        share = friction[last] / (self.faces * normal[last])
        bent = (share - self.damping * velocity[last]) / weight[last]
        times, position, velocity = times[last:], position[last:], velocity[last:]
        reversals = np.flatnonzero(velocity[1:] * velocity[:-1] < 0.0)
        turns = [_turn(times, position, velocity, index) for index in reversals.tolist()]
        for travel in np.diff([position[0], *turns, position[-1]]).tolist():
            limit = copysign(self.coefficient, travel)
            bent -= (limit - bent) * expm1(-self.stiffness * abs(travel) / self.coefficient)
        return float(bent / self.stiffness)


def bristle_reading(values: Mapping[str, float]) -> BristleReading | None:
    """Return how the bristle of a device is read, from its parameters and inputs by name.

    None where there is no bristle that matters: Coulomb friction, averaged motion, which keeps
    none, and no friction at all.
    """
    coefficient, stiffness = values["friction_coefficient"], values["bristle_stiffness"]
    preload, amplitude = values["normal_preload"], values["normal_amplitude"]
    largest = preload + amplitude
    if values["friction_law"] == 0 or values["fidelity"] == 0:
        return None
    if not (coefficient > 0.0 and stiffness > 0.0 and values["friction_faces"] > 0):
        return None
    ratio, phase = values["frequency_ratio"], values["phase"]
    if largest <= 0.0 or (ratio == 0.0 and preload + amplitude * sin(phase) <= 0.0):
        return None
    return BristleReading(
        coefficient,
        stiffness,
        values["bristle_damping"],
        values["friction_faces"],
        _leads(values, phase % tau if ratio > 0.0 else (pi - phase) % tau),
    )


def _leads(values: Mapping[str, float], angle: float) -> tuple[float, ...]:
    """Return the times (s) before the end at which to read, descending to 0.

    `angle` (rad) is that of the normal force at the end, of one that turns forwards.
    """
    preload, amplitude = values["normal_preload"], values["normal_amplitude"]
    drive, turning = values["drive_frequency"], abs(values["frequency_ratio"])
    lead = LEAD * tau / (drive * max(1.0, turning))
    if preload + amplitude * sin(angle) > TOUCHING * (preload + amplitude):
        return tuple((lead * np.linspace(1.0, 0.0, round(POINTS * LEAD) + 1)).tolist())
    flown = (angle - pi - asin(min(1.0, preload / amplitude))) % tau
    if flown > 1.5 * pi:  # no flight is longer than pi: this one is about to begin
        flown = 0.0
    span = flown / (turning * drive) + lead
    mass = values["slider_mass"] + values["resonator_mass"]
    resonator = values["resonator_frequency"] * sqrt(mass / values["slider_mass"])
    fastest = max(drive * max(1.0, turning), resonator)
    count = min(MAX_POINTS, round(POINTS * span * fastest / tau) + 1)
    return tuple((span * np.linspace(1.0, 0.0, count + 1)).tolist())


def _turn(times: Array, position: Array, velocity: Array, index: int) -> float:
    """Return the position (m) where the velocity vanishes between a time and the next."""
    first = min(max(index - 1, 0), max(len(times) - 4, 0))
    near = slice(first, first + 4)
    size = times[index + 1] - times[index]
    local = (times[near] - times[index]) / size
    data = np.column_stack([position[near] - position[index], velocity[near] * size])
    path = scipy.interpolate.KroghInterpolator(np.repeat(local, 2), data.ravel())

    def speed(time: float) -> float:
        return float(path.derivative(time))

    if speed(0.0) * speed(1.0) >= 0.0:  # rounding, of a reversal at one of the two times
        return float(position[index] if abs(speed(0.0)) < abs(speed(1.0)) else position[index + 1])
    turn = scipy.optimize.brentq(speed, 0.0, 1.0, xtol=1e-15)
    return float(position[index] + path(turn))
