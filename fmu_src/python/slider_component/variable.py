"""A variable of an FMU: name, unit, bounds and start value (SI units)."""

from dataclasses import dataclass
from typing import Literal

Type = Literal["Real", "Integer"]
Causality = Literal["input", "parameter", "output"]
Variability = Literal["continuous", "discrete", "tunable", "fixed"]


@dataclass(frozen=True)
class Variable:
    """One row of the interface.

    `start` is None for outputs. `minimum` and `maximum` are inclusive; None means unbounded.
    `depends_on` lists the inputs that an output depends on directly at a communication point,
    `depends_initially_on` the inputs and parameters that it depends on during initialization
    (ModelStructure/InitialUnknowns of FMI 2.0).
    """

    name: str
    description: str
    type: Type
    causality: Causality
    variability: Variability
    start: float | None = None
    unit: str | None = None
    display_unit: str | None = None
    minimum: float | None = None
    maximum: float | None = None
    nominal: float | None = None
    depends_on: tuple[str, ...] = ()
    depends_initially_on: tuple[str, ...] = ()

    @property
    def requirement(self) -> str:
        """What a value must be, in words."""
        kind = "an integer" if self.type == "Integer" else "a finite number"
        unit = f" {self.unit}" if self.unit and self.unit != "1" else ""
        if self.minimum is not None and self.maximum is not None:
            return f"{kind} from {self.minimum:g} to {self.maximum:g}{unit}"
        if self.minimum is not None:
            return f"{kind} of at least {self.minimum:g}{unit}"
        return kind
