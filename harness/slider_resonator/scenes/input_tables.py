"""The tables of a scene file with values over time: inputs, tuning, a second instance."""

from __future__ import annotations

from typing import Literal

from pydantic import Field, field_validator, model_validator

from slider_resonator.device.interface import TUNABLES
from slider_resonator.device.values import check_value
from slider_resonator.scenes.key_table import KeyTable, Number, Point, checked_device, exactly_one


class InputTable(KeyTable):
    """One input: a constant, steps, a ramp (polyline), or a CSV file beside the scene."""

    constant: Number | None = None
    steps: tuple[Point, ...] | None = None
    ramp: tuple[Point, ...] | None = None
    csv: str | None = None
    column: str | None = None
    between: Literal["linear", "hold"] = "linear"

    @model_validator(mode="before")
    @classmethod
    def _plain_number(cls, value: object) -> object:
        return value if isinstance(value, dict) else {"constant": value}

    @model_validator(mode="after")
    def _one_kind(self) -> InputTable:
        kinds = ("constant", "steps", "ramp", "csv")
        given = [kind for kind in kinds if getattr(self, kind) is not None]
        exactly_one("an input", given, "a number, steps, ramp, csv")
        if self.csv is None and self.model_fields_set & {"column", "between"}:
            raise ValueError("column and between belong to a csv")
        return self


class InputsTable(KeyTable):
    """The inputs of the FMU; those left out keep their start value."""

    phase: InputTable = InputTable(constant=0.0)
    load: InputTable = InputTable(constant=0.0)
    frequency_ratio: InputTable = InputTable(constant=1.0)


class TuningTable(KeyTable):
    """Tunable parameters over time, given as inputs are; those left out stay as in `device`."""

    normal_preload: InputTable | None = None
    normal_amplitude: InputTable | None = None
    base_amplitude: InputTable | None = None
    drive_frequency: InputTable | None = None
    tangential_force: InputTable | None = None
    friction_coefficient: InputTable | None = None

    @model_validator(mode="after")
    def _possible(self) -> TuningTable:
        for name, table in self.given.items():
            points = table.steps or table.ramp or ()
            for value in (*(value for _, value in points), table.constant):
                if value is not None:
                    check_value(name, value)
        return self

    @property
    def given(self) -> dict[str, InputTable]:
        """The tuned parameters by name."""
        tables = {name: getattr(self, name) for name in TUNABLES}
        return {name: table for name, table in tables.items() if table is not None}


class BesideTable(KeyTable):
    """A second instance of the FMU, with a device and inputs of its own, beside the first."""

    device: dict[str, Number] = Field(default={})
    inputs: InputsTable = InputsTable()

    @field_validator("device")
    @classmethod
    def _known_parameters(cls, device: dict[str, float]) -> dict[str, float]:
        return checked_device(device)
