"""What the report needs to know of an FMU: velocities and forces without long runs, and courses."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from slider_resonator.device.schedule import constant, schedule
from slider_resonator.errors import FmuError
from slider_resonator.fmu.instance import Instance
from slider_resonator.fmu.run import run
from slider_resonator.steady.blocking_force import find_blocking
from slider_resonator.steady.steady_velocity import find_steady

Array = NDArray[np.float64]


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
    """Return the steady velocity in m/s by shooting.

    Raises FmuError, with the reason, where there is none.
    """
    motion = find_steady(instance, values)
    if motion.steady_velocity is None:
        raise FmuError(f"{instance.fmu.path.name}: {dict(values)}: {motion.reason}")
    return motion.steady_velocity


def blocking_force(instance: Instance, values: Mapping[str, float]) -> float:
    """Return the load in N that stops the device, by shooting.

    Raises FmuError, with the reason, where there is none.
    """
    blocking = find_blocking(instance, values)
    if blocking.blocking_force is None:
        raise FmuError(f"{instance.fmu.path.name}: {dict(values)}: {blocking.reason}")
    return blocking.blocking_force
