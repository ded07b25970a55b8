"""The candidates: fidelity, friction law, tolerance and communication step."""

from __future__ import annotations

from dataclasses import dataclass

COULOMB, LUGRE = 0, 1
TOLERANCES = tuple(10.0**-digits for digits in range(3, 13))
"""Tolerances of resolved LuGre friction, from the cheapest on."""
START_TOLERANCE = 1e-8
"""The FMU's start value, answered where the model has no use for a tolerance."""


@dataclass(frozen=True)
class Model:
    """Fidelity 0, 1 or 2 and friction law, 0 Coulomb or 1 LuGre."""

    fidelity: int
    friction_law: int

    @property
    def name(self) -> str:
        """The model in words."""
        law = "LuGre" if self.friction_law == LUGRE else "Coulomb"
        return f"fidelity {self.fidelity}, {law} friction"

    @property
    def uses_tolerance(self) -> bool:
        """Whether it is integrated; closed forms and averages have an accuracy of their own."""
        return self.fidelity > 0 and self.friction_law == LUGRE

    @property
    def tolerances(self) -> tuple[float, ...]:
        """The tolerances to choose from, descending."""
        return TOLERANCES if self.uses_tolerance else (START_TOLERANCE,)


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
        return {
            "fidelity": self.model.fidelity,
            "friction_law": self.model.friction_law,
            "tolerance": self.tolerance,
        }
