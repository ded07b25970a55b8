"""The schema of a scene file. Every key is listed in its tables; any other is refused."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field, field_validator, model_validator

from slider_resonator.device.interface import INPUTS, PARAMETERS
from slider_resonator.device.values import check_value
from slider_resonator.errors import unknown_name
from slider_resonator.scenes.expect_table import ExpectTable
from slider_resonator.scenes.input_tables import BesideTable, InputsTable, TuningTable
from slider_resonator.scenes.key_table import (
    KeyTable,
    Number,
    Positive,
    checked_device,
    exactly_one,
)
from slider_resonator.scenes.need_table import RUN_NEEDS, STEADY_NEEDS, NeedTable
from slider_resonator.scenes.vocabulary import QUANTITIES


class RunTable(KeyTable):
    """How long the scene runs and in which communication steps, in seconds or drive periods.

    `step_sizes` (s) follow each other over and over; the last step ends at the stop. `start_time`
    (s) is the time at which the FMU starts; all other times of a scene count from there. With
    `read_twice` outputs are read before and after values change, and both are compared.
    """

    stop_time: Positive | None = None
    drive_periods: Positive | None = None
    step_size: Positive | None = None
    steps_per_period: Positive | None = None
    step_sizes: Annotated[tuple[Positive, ...], Field(min_length=1)] | None = None
    start_time: Number = 0.0
    read_twice: Annotated[bool, Field(strict=True)] = False

    @model_validator(mode="after")
    def _one_of_each(self) -> RunTable:
        lengths = ("stop_time", "drive_periods")
        for names in (lengths, ("step_size", "steps_per_period", "step_sizes")):
            given = [name for name in names if getattr(self, name) is not None]
            exactly_one("run", given, " or ".join(names))
        return self


class SweepTable(KeyTable):
    """One parameter or input and its values; every expectation must hold at each."""

    variable: str
    values: tuple[Number, ...]

    @field_validator("variable")
    @classmethod
    def _known_variable(cls, name: str) -> str:
        allowed = [*PARAMETERS, *INPUTS]
        if name not in allowed:
            raise ValueError(unknown_name("parameter or input", name, allowed))
        return name

    @field_validator("values")
    @classmethod
    def _some(cls, values: tuple[float, ...]) -> tuple[float, ...]:
        if not values:
            raise ValueError("must be a list of at least one number")
        return values

    @model_validator(mode="after")
    def _possible(self) -> SweepTable:
        for value in self.values:
            check_value(self.variable, value)
        return self


class SceneTable(KeyTable):
    """A whole scene file."""

    name: str = Field(pattern=r"^[A-Za-z0-9_\-]+$")
    title: str
    description: str = ""
    device: dict[str, Number] = Field(default={})
    inputs: InputsTable = InputsTable()
    tuning: TuningTable = TuningTable()
    beside: BesideTable | None = None
    run: RunTable | None = None
    expect: tuple[ExpectTable, ...] = ()
    sweep: SweepTable | None = None
    need: NeedTable | None = None

    @field_validator("device")
    @classmethod
    def _known_parameters(cls, device: dict[str, float]) -> dict[str, float]:
        return checked_device(device)

    @model_validator(mode="after")
    def _runnable(self) -> SceneTable:
        for name in self.tuning.given:
            if name in self.device:
                raise ValueError(f"{name} is in [device] and in [tuning]; must be in one of them")
            if self.run is None:
                raise ValueError(f"tuning.{name} is for a run: [run] is missing")
        for expect in self.expect:
            quantity = QUANTITIES[expect.quantity]
            if quantity.needs_run and self.run is None:
                raise ValueError(f"{expect.quantity} is measured in a run: [run] is missing")
            if quantity.needs_constants and not self._constant():
                raise ValueError(f"{expect.quantity} needs constant inputs and parameters")
            if quantity.needs_beside and self.beside is None:
                raise ValueError(f"{expect.quantity} needs a second instance: [beside] is missing")
        for need in self.need.needs if self.need else ():
            if need in RUN_NEEDS and self.run is None:
                raise ValueError(f"need.{need} is measured in a run: [run] is missing")
            if need in STEADY_NEEDS and not self._constant():
                raise ValueError(f"need.{need} needs constant inputs and parameters")
        return self

    def _constant(self) -> bool:
        inputs = (self.inputs.phase, self.inputs.load, self.inputs.frequency_ratio)
        tables = (*inputs, *self.tuning.given.values())
        return all(table.constant is not None for table in tables)
