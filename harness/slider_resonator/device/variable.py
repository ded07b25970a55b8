"""A variable of the interface: what is said of it, and which values it may have."""

import sys
from dataclasses import dataclass
from math import isfinite
from numbers import Real
from typing import Any, Literal

from slider_resonator.device.units import SHOWN, is_number, registry, si_number

FIRST = "0.1.0"
"""First version of the interface, all of whose variables an FMU must have."""
LARGEST = sys.float_info.max

Causality = Literal["input", "parameter", "output"]


@dataclass(frozen=True)
class Variable:
    """A variable of the interface, SI units.

    An output has no `start`, and `depends_on` the inputs that act on it at once; None leaves that
    open. A parameter that came with version `since` counts as `without` in an FMU that lacks it.
    """

    name: str
    causality: Causality
    variability: str
    unit: str
    kind: Literal["Real", "Integer"] = "Real"
    start: float | None = None
    minimum: float | None = None
    maximum: float | None = None
    nominal: float | None = None
    depends_on: tuple[str, ...] | None = ()
    since: str = FIRST
    without: float | None = None

    @property
    def requirement(self) -> str:
        """What a value must be, in words."""
        kind = "an integer" if self.kind == "Integer" else "a finite number"
        unit = "" if self.unit == "1" else f" {self.unit}"
        if self.minimum is None:
            return kind
        if self.maximum is None:
            return f"{kind} of at least {self.minimum:g}{unit}"
        return f"{kind} from {self.minimum:g} to {self.maximum:g}{unit}"

    def in_si(self, text: str) -> float:
        """Return the number of a text in the SI unit, as `si_number` does."""
        if self.kind == "Integer" and not is_number(text):
            raise ValueError(f"{self.name} = {text!r}: must be {self.requirement}")
        return si_number(self.name, text, self.unit)

    def shown(self, value: float) -> str:
        """Return a value in the unit that engineers state it in: Hz, deg, um, g, mm/s, mN."""
        if self.unit in ("1", "1/m", "s/m") or not isfinite(value):
            return f"{value:.6g} {self.unit}".removesuffix(" 1")
        stated = SHOWN.get(self.unit, self.unit)
        quantity = registry().Quantity(float(value), self.unit).to(stated)
        compact = quantity.to_compact() if quantity and self.unit != "rad" else quantity
        return f"{compact:.6g~P}".replace("µ", "u")

    def read(self, value: object) -> float:
        """Return a number, or a text with a unit, in SI units: a float, or the int of an Integer.

        Raises ValueError, with name, value and requirement, for one that the interface refuses.
        """
        if isinstance(value, str):
            value = self.in_si(value)
        if isinstance(value, bool) or not isinstance(value, Real):
            raise ValueError(f"{self.name} = {value!r}: must be a number")
        number: Any = getattr(value, "item", lambda: value)()  # those of numpy have other bounds
        kind = int if self.kind == "Integer" else float
        low = -LARGEST if self.minimum is None else self.minimum
        high = LARGEST if self.maximum is None else self.maximum
        if not low <= number <= high or (kind is int and number % 1 != 0):
            shown = repr(number).removesuffix(".0" if kind is int else "")
            raise ValueError(f"{self.name} = {shown}: must be {self.requirement}")
        return kind(number)
