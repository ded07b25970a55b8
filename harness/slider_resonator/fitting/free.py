"""Parameters that are free in a fit: what they may be, and the numbers that are estimated."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf, isfinite
from typing import Any

import numpy as np

from slider_resonator.device.interface import INTEGERS, PARAMETERS, VARIABLES
from slider_resonator.errors import HarnessError, unknown_name

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
    names: Sequence[str], parameters: Mapping[str, float], bounds: Mapping[str, Any]
) -> tuple[Free, ...]:
    """Return the parameters to estimate, from those of the device.

    `bounds` are pairs of numbers in SI units or texts with a unit. Raises HarnessError with name,
    value and requirement.
    """
    for name in [*names, *bounds]:
        if name not in PARAMETERS or name in INTEGERS:
            if name in VARIABLES:
                raise HarnessError(f"{name} cannot be free; must be a parameter that is no integer")
            raise HarnessError(unknown_name("parameter", name, {*PARAMETERS} - {*INTEGERS}))
        if name not in names:
            raise HarnessError(f"bounds of {name}: it is not free; must be one of the free ones")
    if not names:
        raise HarnessError("free: names nothing; must be one parameter or more")
    if len(set(names)) < len(names):
        raise HarnessError(f"free = {', '.join(names)!r}: must be different parameters")
    return tuple(_free(name, parameters, bounds.get(name)) for name in names)


def _free(name: str, parameters: Mapping[str, float], bounds: Any) -> Free:
    """Return a parameter between its bounds, if it has some, or what the search is confined to."""
    variable = VARIABLES[name]
    start = float(parameters.get(name, variable.start or 0.0))
    least = -inf if variable.minimum is None else variable.minimum
    most = inf if variable.maximum is None else variable.maximum
    low, high = least, most
    if bounds is not None:
        try:
            low, high = (variable.in_si(b) if isinstance(b, str) else float(b) for b in bounds)
        except (TypeError, ValueError) as error:
            raise HarnessError(
                f"bounds of {name} = {bounds!r}: must be two numbers in {variable.unit}, or texts "
                "with a unit"
            ) from error
        if not (least <= low < high <= most and isfinite(high - low)):
            raise HarnessError(
                f"bounds of {name} = {low:g} to {high:g}: must be ascending, each "
                f"{variable.requirement}"
            )
    elif least >= 0.0 and start > 0.0:
        low, high = max(least, start / WIDE), min(most, start * WIDE)
    search_bounds = () if bounds is not None else tuple({low, high} - {least, most})
    return Free(name, min(max(start, low), high), low, high, search_bounds)
