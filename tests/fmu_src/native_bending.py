"""Panels of bending bristles of the native component, by their probe."""

import ctypes
import math
import random
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_src.python.slider_component.variables import VARIABLES

Values = Mapping[str, float]
"""Values of variables by name, start values for the others."""


@dataclass(frozen=True)
class PanelErrors:
    """Errors of one panel: of velocity (m/s) and travel (m) at its end, of the velocity a fifth
    later, and of the travel within it."""

    velocity: float
    travel: float
    later: float
    within: float


@dataclass(frozen=True)
class NativeBending:
    """The C sources and the probe as a library."""

    library: ctypes.CDLL

    def decay(self, x: NDArray[np.float64]) -> NDArray[np.float64]:
        found = np.zeros_like(x)
        self.library.decays(_pointer(x), len(x), _pointer(found))
        return found

    def gauss(self) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Return nodes, weights, and integrals of [0, 1] from 0 to each node and to 1."""
        node, weight, integral = np.zeros(16), np.zeros(16), np.zeros((17, 16))
        self.library.gauss(*(_pointer(row) for row in (node, weight, integral)))
        return node, weight, integral

    def panel(
        self, values: Values, start: float, tolerance: float, share: float
    ) -> PanelErrors | None:
        """Return the errors of the panel after the first reversal past `start` (s), if there is."""
        errors = np.zeros(4)
        given = (ctypes.c_double(number) for number in (start, tolerance, share))
        found = self.library.panel_errors(_values(values), *given, _pointer(errors))
        return PanelErrors(*errors.tolist()) if found else None


def sliding_device(seed: int) -> dict[str, float]:
    """Table 1 with LuGre friction and other bristles, friction and load: slides to and fro."""
    draw = random.Random(seed)

    def decades(low: float, high: float) -> float:
        return math.exp(draw.uniform(math.log(low), math.log(high)))

    return {
        "friction_law": 1,
        "resonator_frequency": 3500.0 * decades(0.5, 2.0),
        "damping_ratio": draw.choice([0.0, decades(1e-3, 0.3)]),
        "normal_amplitude": draw.choice([0.0, 0.5, 1.0, 1.8]),
        "base_amplitude": decades(5e-5, 1e-3),
        "friction_coefficient": decades(0.02, 2.0),
        "bristle_stiffness": decades(1e4, 1e12),
        "bristle_damping": draw.choice([0.0, decades(0.1, 100.0)]),
        "fidelity": draw.choice([1, 2]),
        "phase": draw.uniform(-3.0, 3.0),
        "frequency_ratio": draw.choice([1.0, 1.0, 1.001, 2.0, 3.0, 0.0, draw.uniform(-3.0, 3.0)]),
    }


def _values(values: Values) -> object:
    unknown = set(values) - {variable.name for variable in VARIABLES}
    if unknown:
        raise ValueError(f"unknown variables: {unknown}")
    starts = [0.0 if variable.start is None else float(variable.start) for variable in VARIABLES]
    given = [values.get(v.name, start) for v, start in zip(VARIABLES, starts, strict=True)]
    return (ctypes.c_double * len(given))(*given)


def _pointer(numbers: NDArray[np.float64]) -> object:
    return numbers.ctypes.data_as(ctypes.POINTER(ctypes.c_double))
