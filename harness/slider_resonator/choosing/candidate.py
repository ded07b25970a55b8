"""The candidates: fidelity, averaging order, friction law, tolerance and communication step."""

from dataclasses import dataclass

from slider_resonator.device.model import LUGRE, Model

TOLERANCES = tuple(10.0**-digits for digits in range(3, 13))
"""Tolerances of LuGre friction and of leaps, from the cheapest on."""
START_TOLERANCE = 1e-8
"""The FMU's start value, answered where the model has no use for a tolerance."""


def uses_tolerance(model: Model) -> bool:
    """Whether a model integrates a bristle or leaps over periods; else its accuracy is its own."""
    return model.leaps or (model.friction_law == LUGRE and model.fidelity > 0)


def tolerances(model: Model) -> tuple[float, ...]:
    """Return the tolerances to choose from, descending."""
    return TOLERANCES if uses_tolerance(model) else (START_TOLERANCE,)


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
