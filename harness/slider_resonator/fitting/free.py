"""Parameters that are free in a fit: what they may be, and the numbers that are estimated."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import isfinite
from typing import Any

import numpy as np

from slider_resonator.device.interface import INPUTS, INTEGERS, PARAMETERS, VARIABLES
from slider_resonator.errors import HarnessError, explained, unknown_name

WIDE = 1e4
"""Factor beside the start to which a positive parameter without other bounds is confined."""


@dataclass(frozen=True)
class Free:
    """A parameter to be estimated between two bounds, in SI units.

    Those of `search_bounds` only confine the search: an interval that reaches one is unbounded.
    """

    name: str
    start: float
    low: float
    high: float
    search_bounds: tuple[float, ...] = ()

    @property
    def is_relative(self) -> bool:
        """Whether the logarithm is estimated: of a parameter that cannot be negative."""
        return self.low >= 0.0 and self.start > 0.0

    def internal(self, value: float) -> float:
        """Return the number that is estimated."""
        if self.is_relative:
            return float(np.log(max(value, 1e-300)))
        return value / self._scale

    def value(self, internal: float) -> float:
        """Return the parameter, in SI units."""
        value = float(np.exp(internal)) if self.is_relative else internal * self._scale
        return min(max(value, self.low), self.high)

    def slope(self, value: float) -> float:
        """Return the change of the parameter by that of the internal number, at a value."""
        return value if self.is_relative else self._scale

    @property
    def _scale(self) -> float:
        return abs(self.start) or VARIABLES[self.name].nominal or 1.0


def free_parameters(
    names: Sequence[str],
    parameters: Mapping[str, float],
    bounds: Mapping[str, tuple[float, float]],
) -> tuple[Free, ...]:
    """Return the parameters to estimate, from those of the device.

    Raises HarnessError with name, value and requirement.
    """
    possible = sorted({*PARAMETERS} - {*INTEGERS})
    for name in [*names, *bounds]:
        if name in INPUTS:
            raise HarnessError(
                f"{name} is an input; must be a parameter, one of {', '.join(possible)}"
            )
        if name not in PARAMETERS:
            raise HarnessError(unknown_name("parameter", name, possible))
        if name not in names:
            raise HarnessError(f"bounds of {name}: it is not free; must be one of the free ones")
        if name in INTEGERS:
            raise HarnessError(
                f"{name} is an integer; must be a parameter that varies continuously"
            )
    if not any(names):
        raise HarnessError("free: names nothing; must be one parameter or more")
    if len(set(names)) < len(names):
        raise HarnessError(f"free = {', '.join(names)!r}: must be different parameters")
    found = []
    for name in names:
        variable = VARIABLES[name]
        start = float(parameters.get(name, variable.start or 0.0))
        low = -np.inf if variable.minimum is None else variable.minimum
        high = np.inf if variable.maximum is None else variable.maximum
        search_bounds: tuple[float, ...] = ()
        if name in bounds:
            low, high = _both_bounds(name, bounds[name])
        elif low >= 0.0 and start > 0.0:
            allowed = low, high
            low, high = max(low, start / WIDE), min(high, start * WIDE)
            search_bounds = tuple({low, high} - {*allowed})
        for bound in (low, high):
            if isfinite(bound):
                with explained("bounds of "):
                    VARIABLES[name].read(bound)
        if not low < high:
            raise HarnessError(f"bounds of {name} = {low:g} to {high:g}: must be ascending")
        start = min(max(start, low), high)
        found.append(Free(name, start, float(low), float(high), search_bounds))
    return tuple(found)


def _both_bounds(name: str, bounds: Any) -> tuple[float, float]:
    """Return two bounds in SI units, given as numbers or as texts with a unit."""
    try:
        variable = VARIABLES[name]
        low, high = (variable.in_si(one) if isinstance(one, str) else float(one) for one in bounds)
    except (TypeError, ValueError) as error:
        raise HarnessError(
            f"bounds of {name} = {bounds!r}: must be two numbers, or texts with a unit"
        ) from error
    return low, high
