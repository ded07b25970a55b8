"""What the paper's figures need to know of an FMU: velocities without long runs, and time courses.

Coulomb velocities come from `find_steady`. A LuGre bristle is a state that no output shows, so the
FMU starts at the velocity that theory gives and the geometric decay of what is left is extrapolated
(Aitken): three mean velocities at equal distances give the limit, and two limits in a row that
agree are taken for settled.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import ceil, pi

import numpy as np
from numpy.typing import NDArray

from harness.drive import Instance, run
from harness.errors import FmuError
from harness.schedule import constant, schedule
from harness.steady import find_steady

Array = NDArray[np.float64]

SETTLED = 2e-6
"""Largest difference between two extrapolated velocities in a row, in units of the strength."""
LONGEST_BLOCKS = 60


@dataclass(frozen=True)
class Course:
    """Position and velocity of a run at times, each shape (n,)."""

    time: Array
    position: Array
    velocity: Array

    def plain(self) -> dict[str, list[float]]:
        """Return the course as lists."""
        return {
            "time": self.time.tolist(),
            "position": self.position.tolist(),
            "velocity": self.velocity.tolist(),
        }


def course(instance: Instance, values: Mapping[str, float], stop: float, points: int) -> Course:
    """Return a run from 0 to ``stop`` (s) at ``points`` equal steps."""
    inputs = {"phase", "load", "frequency_ratio"}
    signals = {name: constant(value) for name, value in values.items() if name in inputs}
    parameters = {name: value for name, value in values.items() if name not in inputs}
    record = run(
        instance,
        parameters,
        schedule(stop, stop / points, **signals),
        outputs=("position", "velocity"),
    )
    return Course(record.times, record["position"], record["velocity"])


def steady_velocity(instance: Instance, values: Mapping[str, float]) -> float:
    """Return the steady velocity of a Coulomb case in m/s by shooting.

    Raises FmuError, with the reason, where there is none.
    """
    motion = find_steady(instance, values)
    if motion.steady_velocity is None:
        raise FmuError(f"{instance.fmu.path.name}: {dict(values)}: {motion.reason}")
    return motion.steady_velocity


def settled_velocity(
    instance: Instance,
    values: Mapping[str, float],
    guess: float,
    *,
    turns: float = 0.25,
    start_bristle: float = 0.0,
) -> float:
    """Return the steady velocity of any case in m/s, started near ``guess`` (m/s).

    ``turns`` (s) is the distance between the mean velocities that are extrapolated, rounded up to
    whole drive periods. Raises FmuError when it does not settle.
    """
    strength = _fast_velocity(values)
    period = 2.0 * pi / values["drive_frequency"]
    count = max(1, ceil(turns / period))
    start = {"initial_velocity": guess - strength, "initial_bristle_deflection": start_bristle}
    instance.start({**values, **start})
    read = instance.block(["mean_velocity"])
    means: list[float] = []
    limits: list[float] = []
    with instance.explained():
        for block in range(1, LONGEST_BLOCKS + 1):
            instance.step_to(block * count * period)
            means.append(read.read()[0])
            if len(means) >= 3:
                limits.append(_extrapolated(means[-3:]))
            if len(limits) >= 2 and abs(limits[-1] - limits[-2]) <= SETTLED * strength:
                return limits[-1]
    raise FmuError(
        f"{instance.fmu.path.name}: {dict(values)}: the mean velocity has not settled after "
        f"{LONGEST_BLOCKS * count} drive periods, the last is {means[-1]!r} m/s"
    )


def blocking_load(
    instance: Instance, values: Mapping[str, float], guess: float, *, turns: float = 0.25
) -> float:
    """Return the load in N under which the settled velocity of any case vanishes, by secants.

    Raises FmuError as `settled_velocity` does, or when the secants do not close in on it.
    """
    scale = _fast_velocity(values)

    def velocity(load: float) -> float:
        return settled_velocity(instance, {**values, "load": load}, 0.0, turns=turns)

    before, load = guess, guess * 0.99
    fast, slow = velocity(before), velocity(load)
    for _ in range(12):
        if abs(slow) <= 2.0 * SETTLED * scale:
            return load
        before, load = load, load - slow * (load - before) / (slow - fast)
        fast, slow = slow, velocity(load)
    raise FmuError(f"{instance.fmu.path.name}: {dict(values)}: no blocking load near {guess!r} N")


def _fast_velocity(values: Mapping[str, float]) -> float:
    """Return the amplitude in m/s of the fast velocity under direct drive, q for a mass of 1 kg."""
    return values["tangential_force"] / (values["drive_frequency"] * values["slider_mass"])


def _extrapolated(means: list[float]) -> float:
    first, second, third = means
    bend = (third - second) - (second - first)
    ratio = (third - second) / (second - first) if second != first else 0.0
    if bend == 0.0 or not abs(ratio) < 1.0:
        return third
    return third - (third - second) ** 2 / bend
