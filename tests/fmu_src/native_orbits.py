"""The native finder of held orbits, by its probe."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_src.python.slider_component.variables import VARIABLES
from tests.fmu_src.orbit_devices import Case

HELD, STEADY = 0, 1


@dataclass(frozen=True)
class Orbit:
    """What the probe tells of an orbit, and of the moment at the drive phase that was asked for."""

    velocity: float
    friction: float
    factor: float
    slope: float
    fast_multiplier: float
    reversals: float
    sticks: float
    maps: float
    slider_velocity: float
    displacement: float
    rate: float
    bristle: float
    position: float
    offset: float
    speed: float


@dataclass(frozen=True)
class NativeOrbits:
    """The C sources and the probe as a library."""

    library: ctypes.CDLL

    def find(
        self,
        case: Case,
        kind: int,
        given: float,
        *,
        neighbour: float = 0.0,
        excess: float = 0.0,
        theta: float = 0.0,
    ) -> tuple[int, Orbit]:
        """Return the status and the orbit, which means nothing where the status is not 0."""
        names = Orbit.__dataclass_fields__
        numbers = np.zeros(len(names))
        rest = (given, neighbour, excess, theta)
        doubles = (ctypes.c_double(number) for number in rest)
        status = self.library.find_orbit(*_device(case), kind, *doubles, _pointer(numbers))
        return int(status), Orbit(**dict(zip(names, numbers.tolist(), strict=True)))

    def run(
        self, case: Case, load: float, velocity: float, periods: int
    ) -> NDArray[np.float64] | None:
        """Return position, velocity, displacement and rate, (4, periods + 1); None on failure."""
        states = np.zeros((periods + 1, 4))
        start = (ctypes.c_double(load), ctypes.c_double(velocity))
        failed = self.library.run_periods(*_device(case), *start, periods, _pointer(states))
        return None if failed else states.T


def _device(case: Case) -> tuple[object, ...]:
    starts = [0.0 if variable.start is None else float(variable.start) for variable in VARIABLES]
    values = [
        float(getattr(case.device, variable.name, start))
        for variable, start in zip(VARIABLES, starts, strict=True)
    ]
    array = (ctypes.c_double * len(values))(*values)
    return array, ctypes.c_double(case.ratio), case.turns, ctypes.c_double(case.lead)


def _pointer(numbers: NDArray[np.float64]) -> object:
    return numbers.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
