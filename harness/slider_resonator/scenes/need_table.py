"""The table [need] of a scene file."""

from __future__ import annotations

from typing import Literal

from pydantic import model_validator

from slider_resonator.scenes.key_table import KeyTable, Positive

STEADY_NEEDS = ("steady_velocity", "blocking_force")
"""Needs in the steady motion under constant inputs."""
RUN_NEEDS = ("mean_velocity", "position", "velocity", "event_times", "beat")
"""Needs that are measured in a run."""


class AllowedTable(KeyTable):
    """Allowed error of a needed quantity: `abs + rel * size`, where either may be left out.

    `abs` is in the quantity's unit. The size is the magnitude of a number, the peak of a signal and
    the drive period for event times.
    """

    abs: Positive | None = None
    rel: Positive | None = None

    @model_validator(mode="before")
    @classmethod
    def _a_table(cls, value: object) -> object:
        if not isinstance(value, dict):
            raise ValueError("must be a table with abs or rel, such as { rel = 0.01 }")
        return value

    @model_validator(mode="after")
    def _some_tolerance(self) -> AllowedTable:
        if self.abs is None and self.rel is None:
            raise ValueError("needs a tolerance: abs, rel or both")
        return self

    def at(self, size: float) -> float:
        """Return the allowed error for a quantity of this size, both in the quantity's unit."""
        return (self.abs or 0.0) + (self.rel or 0.0) * abs(size)


class NeedTable(KeyTable):
    """The quantities that the scene needs, and how accurately.

    `friction_law = "free"` allows either law.
    """

    mean_velocity: AllowedTable | None = None
    position: AllowedTable | None = None
    velocity: AllowedTable | None = None
    steady_velocity: AllowedTable | None = None
    blocking_force: AllowedTable | None = None
    event_times: AllowedTable | None = None
    beat: AllowedTable | None = None
    friction_law: Literal["given", "free"] = "given"

    @model_validator(mode="after")
    def _some_need(self) -> NeedTable:
        if not self.needs:
            raise ValueError(f"needs at least one of {', '.join((*STEADY_NEEDS, *RUN_NEEDS))}")
        return self

    @property
    def needs(self) -> dict[str, AllowedTable]:
        """The needed quantities by name."""
        tables = {name: getattr(self, name) for name in (*STEADY_NEEDS, *RUN_NEEDS)}
        return {name: table for name, table in tables.items() if table is not None}
