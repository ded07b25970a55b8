"""The result of a search by shooting, for a velocity or a load."""

from abc import abstractmethod
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from slider_resonator.device.interface import INPUTS, VARIABLES
from slider_resonator.output.readable import number_of, one_line, readable
from slider_resonator.output.shown import Shown
from slider_resonator.steady.periodic import Facts, FmuPeriodMap
from slider_resonator.steady.shooting import FixedPoint, NoFixedPoint


@dataclass(frozen=True, repr=False)
class SearchResult(Shown):
    """Status, reason and cost of a search.

    `status` is for machines, `reason` for people; `predicted` is the FMU's own output and
    `prediction_valid` what the FMU says of it, None where it has no such output. `inputs` are those
    that were held, in SI units, with friction on `friction_faces`.
    The common period has `common_period` drive periods; `periods` counts all simulated ones.
    `multipliers` are the Floquet multipliers, largest first, `residual` the largest change of the
    state over the common period in units of its scale.
    """

    status: str
    reason: str
    predicted: float
    prediction_valid: bool | None
    inputs: Mapping[str, float]
    friction_faces: int
    common_period: int | None = None
    periods: int = 0
    iterations: int = 0
    residual: float | None = None
    multipliers: tuple[complex, ...] = ()
    stable: bool | None = None

    @property
    @abstractmethod
    def answer(self) -> tuple[str, float | None, str]:
        """What was searched, its value, None where there is none, and its unit."""

    def describe(self) -> list[str]:
        """Return the answer, why it is one, and what it cost."""
        what, value, unit = self.answer
        found = "none" if value is None else f"{readable(value, 10)} {unit}"
        how = "read without a run"
        if self.prediction_valid is False:
            how += "; the FMU says that it does not hold here: prediction_valid = 0"
        lines = [
            f"{what:<17}{found}",
            f"status           {self.status}: {one_line(self.reason)}",
            f"FMU's output     {readable(self.predicted, 10)} {unit} ({how})",
        ]
        if self.common_period is not None:
            lines.append(
                f"cost             {number_of(self.periods, 'drive period')} in "
                f"{number_of(self.iterations, 'iteration')}, "
                f"a common period is {self.common_period} of them"
            )
        if self.multipliers:
            sizes = ", ".join(f"{abs(multiplier):.6f}" for multiplier in self.multipliers)
            lines.append(f"multipliers      {sizes} (magnitudes)")
        held = (
            f"{name} {readable(value, 6)} {VARIABLES[name].unit}".removesuffix(" 1")
            for name, value in self.inputs.items()
        )
        return [
            *lines,
            f"inputs           {', '.join(held)}",
            f"friction         on {number_of(self.friction_faces, 'face')} (friction_faces)",
        ]


def asked(facts: Facts, searched: str = "") -> dict[str, Any]:
    """Return the fields of a result that say what was asked, without the input that is searched."""
    return {
        "prediction_valid": facts.prediction_valid,
        "inputs": {name: facts[name] for name in INPUTS if name != searched},
        "friction_faces": int(facts["friction_faces"]),
    }


def cost(period_map: FmuPeriodMap, found: FixedPoint | NoFixedPoint | None) -> dict[str, Any]:
    """Return the fields of a result that follow from the search itself."""
    fields: dict[str, Any] = {
        "common_period": period_map.drive_periods,
        "periods": period_map.periods,
    }
    if found is not None:
        fields |= {"iterations": found.iterations, "residual": found.residual}
    if isinstance(found, FixedPoint):
        fields["multipliers"] = tuple(found.multipliers.tolist())
        fields["stable"] = found.stability == "stable"
    return fields


def with_undamped_hint(reason: str, facts: Facts) -> str:
    """Add to a reason that the resonator is undamped, if it is."""
    if facts["damping_ratio"] > 0.0:
        return reason
    return f"{reason} (damping_ratio = 0: the transient of the resonator never decays)"
