"""The candidates: fidelity, averaging order, friction law, tolerance and communication step."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

COULOMB, LUGRE = 0, 1
TOLERANCES = tuple(10.0**-digits for digits in range(3, 13))
"""Tolerances of LuGre friction and of leaps, from the cheapest on."""
START_TOLERANCE = 1e-8
"""The FMU's start value, answered where the model has no use for a tolerance."""


@dataclass(frozen=True)
class Model:
    """Fidelity 0, 1 or 2 and friction law, 0 Coulomb or 1 LuGre.

    `averaging_order` is that of fidelity 0, None where the FMU has no such parameter.
    """

    fidelity: int
    friction_law: int
    averaging_order: int | None = None

    @property
    def name(self) -> str:
        """The model in words."""
        law = "LuGre" if self.friction_law == LUGRE else "Coulomb"
        order = f", order {self.averaging_order}" if self.averaging_order else ""
        return f"fidelity {self.fidelity}{order}, {law} friction"

    @property
    def parameters(self) -> dict[str, float]:
        """The FMU parameters that make it."""
        order = {"averaging_order": self.averaging_order} if self.averaging_order else {}
        return {"fidelity": self.fidelity, "friction_law": self.friction_law, **order}

    @property
    def uses_tolerance(self) -> bool:
        """Whether it integrates a bristle or leaps over periods; else its accuracy is its own."""
        return self.averaging_order == 2 or (self.friction_law == LUGRE and self.fidelity > 0)

    @property
    def tolerances(self) -> tuple[float, ...]:
        """The tolerances to choose from, descending."""
        return TOLERANCES if self.uses_tolerance else (START_TOLERANCE,)


def models(laws: Iterable[int], averaging_orders: Iterable[int | None]) -> list[Model]:
    """Return the models of some friction laws, the averaged ones of some orders."""
    laws, orders = tuple(laws), tuple(averaging_orders)
    averaged = [Model(0, law, order) for order in orders for law in laws]
    return averaged + [Model(fidelity, law) for fidelity in (1, 2) for law in laws]


@dataclass(frozen=True)
class Candidate:
    """A model with the tolerance (1) and communication step (s) it is run with.

    `step` is None where nothing is run.
    """

    model: Model
    tolerance: float
    step: float | None

    @property
    def parameters(self) -> dict[str, float]:
        """The FMU parameters that make it."""
        return {**self.model.parameters, "tolerance": self.tolerance}
