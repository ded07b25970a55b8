"""A cell of the stability matrix: its run and its place."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import tau

from slider_resonator.device.device import Device

SUBSTEPS = 3
"""Substeps per step in the second partition of a cell, for steps that do not repeat."""
MIN_DIVISIBLE = 1e-300
"""Steps up to this size, s, are not divided."""

LEAP_TOLERANCE = 1e-6
"""Tolerance of averages of second order, under which they leap over periods."""


@dataclass(frozen=True)
class Hold:
    """Inputs (rad, N, 1) held over `count` communication steps of `size` (s)."""

    size: float
    count: int = 1
    phase: float = 0.4
    load: float = 0.0
    frequency_ratio: float = 1.0

    @property
    def inputs(self) -> tuple[float, float, float]:
        """Phase, load, frequency_ratio."""
        return self.phase, self.load, self.frequency_ratio


@dataclass(frozen=True)
class Model:
    """A column of the matrix: degrees of freedom, friction law, and the order of averages."""

    fidelity: int
    friction_law: int
    averaging_order: int = 1

    @property
    def name(self) -> str:
        """The column's heading."""
        law = "LuGre" if self.friction_law else "Coulomb"
        order = ", order 2" if self.second_order else ""
        return f"{law}, fidelity {self.fidelity}{order}"

    @property
    def second_order(self) -> bool:
        """Whether it is motion by averages of second order."""
        return self.fidelity == 0 and self.averaging_order == 2


@dataclass(frozen=True)
class Limit:
    """A limit case: the value that an output must have at the end, and the reason."""

    output: str
    value: float
    allowed: float
    why: str


@dataclass(frozen=True)
class MatrixCell:
    """One run: the value `value` on the axis `axis`, by one model.

    `parameters` are those that differ from table 1. `from_zero` asks for the same motion when the
    run starts at time 0, `restored` for the same one after a return to a stored state.
    """

    axis: str
    value: str
    model: Model
    parameters: Mapping[str, float]
    holds: tuple[Hold, ...]
    start_time: float = 0.0
    from_zero: bool = False
    restored: bool = False
    limits: tuple[Limit, ...] = ()

    @property
    def name(self) -> str:
        """Axis, value and model."""
        return f"{self.axis}: {self.value}: {self.model.name}"

    @property
    def settings(self) -> dict[str, float]:
        """All parameters that are set in the FMU."""
        chosen = {"fidelity": self.model.fidelity, "friction_law": self.model.friction_law}
        if self.model.fidelity == 0:
            chosen["averaging_order"] = self.model.averaging_order
        usual = {"tolerance": LEAP_TOLERANCE} if self.model.second_order else {}
        return {**usual, **self.parameters, **chosen}

    @property
    def device(self) -> Device:
        """The device for the references."""
        return Device.from_mapping(self.settings)

    @property
    def period(self) -> float:
        """The drive period, s."""
        return tau / self.device.drive_frequency

    @property
    def other_holds(self) -> tuple[Hold, ...]:
        """The same inputs over the same times in other steps: repeated merged, others divided."""
        if any(hold.count > 1 for hold in self.holds):
            return tuple(replace(h, size=h.size * h.count, count=1) for h in self.holds)
        return tuple(
            replace(h, size=h.size / SUBSTEPS, count=SUBSTEPS) if h.size > MIN_DIVISIBLE else h
            for h in self.holds
        )


RESOLVED_COULOMB = Model(2, 0)
MODELS = (
    *(RESOLVED_COULOMB, Model(1, 0), Model(0, 0), Model(0, 0, 2)),
    *(Model(2, 1), Model(1, 1), Model(0, 1), Model(0, 1, 2)),
)
CHEAP = tuple(model for model in MODELS if model != Model(0, 1, 2))
"""All but LuGre friction by averages of second order, whose cells take longest: that is left out on
axes that try nothing of it that others do not."""
RESOLVED = tuple(model for model in MODELS if model.fidelity > 0)
LUGRE = tuple(model for model in MODELS if model.friction_law == 1)
CHEAP_LUGRE = tuple(model for model in CHEAP if model.friction_law == 1)
COULOMB_RESOLVED = tuple(model for model in RESOLVED if model.friction_law == 0)
