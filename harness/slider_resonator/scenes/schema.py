"""The schema of a scene file. Every key is listed here; any other is refused."""

from __future__ import annotations

from math import isfinite
from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from slider_resonator.device.interface import INPUTS, PARAMETERS, TUNABLES
from slider_resonator.device.values import check_value
from slider_resonator.errors import unknown_name
from slider_resonator.scenes.vocabulary import MAX_TUBE, QUANTITIES, Quantity

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0.0)]
NotNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0)]
Point = tuple[Number, Number]

STEADY_NEEDS = ("steady_velocity", "blocking_force")
"""Needs in the steady motion under constant inputs."""
RUN_NEEDS = ("mean_velocity", "position", "velocity", "event_times", "beat")
"""Needs that are measured in a run."""


class _Table(BaseModel):
    model_config = ConfigDict(extra="forbid", frozen=True)


def _exactly_one(table: str, given: list[str], choices: str) -> None:
    if len(given) != 1:
        raise ValueError(f"{table} needs exactly one of {choices}, has {given or 'none'}")


class InputTable(_Table):
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
        _exactly_one("an input", given, "a number, steps, ramp, csv")
        if self.csv is None and self.model_fields_set & {"column", "between"}:
            raise ValueError("column and between belong to a csv")
        return self


class InputsTable(_Table):
    """The inputs of the FMU; those left out keep their start value."""

    phase: InputTable = InputTable(constant=0.0)
    load: InputTable = InputTable(constant=0.0)
    frequency_ratio: InputTable = InputTable(constant=1.0)


class TuningTable(_Table):
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


class BesideTable(_Table):
    """A second instance of the FMU, with a device and inputs of its own, beside the first."""

    device: dict[str, Number] = {}
    inputs: InputsTable = InputsTable()

    @field_validator("device")
    @classmethod
    def _known_parameters(cls, device: dict[str, float]) -> dict[str, float]:
        return _checked_device(device)


class RunTable(_Table):
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
            _exactly_one("run", given, " or ".join(names))
        return self


class ExpectTable(_Table):
    """One expectation: a quantity of the FMU against a reference, a value or a bound.

    The allowed deviation is `absolute + relative * |reference|`; for a signal it is `relative`, a
    share of the reference's peak, and an `absolute` beside it is for a reference near zero.
    Without an `absolute` a reference counts as no smaller than a hundredth of its natural scale.
    A real number needs a tolerance, be it 0. A `tube` allows a signal to be early or late by a
    share of the drive period; for event times it is the tolerance.
    """

    quantity: str
    reference: str | None = None
    value: float | str | None = None
    at_most: Number | None = None
    at_least: Number | None = None
    absolute: NotNegative = 0.0
    relative: NotNegative = 0.0
    tube: Annotated[float, Field(strict=True, gt=0.0, lt=MAX_TUBE)] | None = None
    why: str

    @field_validator("quantity")
    @classmethod
    def _known_quantity(cls, name: str) -> str:
        if name not in QUANTITIES:
            raise ValueError(unknown_name("quantity", name, QUANTITIES))
        return name

    @field_validator("value", mode="before")
    @classmethod
    def _number_or_word(cls, value: object) -> object:
        number = isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value)
        if not (number or isinstance(value, str)):
            raise ValueError("must be a finite number or a text in quotes")
        return value

    @model_validator(mode="after")
    def _comparable(self) -> ExpectTable:
        kinds = ("reference", "value", "at_most", "at_least")
        given = [kind for kind in kinds if getattr(self, kind) is not None]
        _exactly_one("expect", given, ", ".join(kinds))
        quantity = QUANTITIES.get(self.quantity)
        if quantity is None:
            return self
        if self.reference is not None and self.reference not in quantity.references:
            name = f"reference for {self.quantity}"
            raise ValueError(unknown_name(name, self.reference, quantity.references))
        if quantity.kind == "signal" and self.reference is None:
            raise ValueError(f"{self.quantity} is a signal: it needs a reference")
        if isinstance(self.value, str) != (quantity.kind == "word") and self.value is not None:
            raise ValueError(
                f"{self.quantity} is a {quantity.kind}, the value {self.value!r} is not"
            )
        if given in (["at_most"], ["at_least"]) and quantity.kind != "number":
            raise ValueError(f"{self.quantity} is a {quantity.kind}: it cannot have a bound")
        if given in (["reference"], ["value"]):
            self._check_tolerance(quantity)
        return self

    def _check_tolerance(self, quantity: Quantity) -> None:
        if quantity.in_periods:
            given = sorted(self.model_fields_set & {"absolute", "relative"})
            if self.tube is None or given:
                raise ValueError(f"{self.quantity} needs a tube, a share of the period, alone")
            return
        if self.tube is not None and self.reference not in quantity.tube_references:
            allowed = ", ".join(quantity.tube_references) or "none"
            raise ValueError(
                f"tube = {self.tube!r}: references of {self.quantity} that allow one: {allowed}"
            )
        signal = quantity.kind == "signal"
        alone = quantity.exact or not self.relative > 0.0
        if signal and "absolute" in self.model_fields_set and alone:
            raise ValueError(f"{self.quantity} is a signal: must be relative, not absolute alone")
        if not quantity.exact and not self.model_fields_set & {"absolute", "relative"}:
            needed = "relative, a share of the peak" if signal else "relative or absolute"
            raise ValueError(f"{self.quantity} is a real number: it needs a tolerance, {needed}")


class SweepTable(_Table):
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


class AllowedTable(_Table):
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


class NeedTable(_Table):
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


class SceneTable(_Table):
    """A whole scene file."""

    name: str = Field(pattern=r"^[A-Za-z0-9_\-]+$")
    title: str
    description: str = ""
    device: dict[str, Number] = {}
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
        return _checked_device(device)

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


def _checked_device(device: dict[str, float]) -> dict[str, float]:
    for name, value in device.items():
        if name not in PARAMETERS:
            raise ValueError(unknown_name("parameter", name, PARAMETERS))
        check_value(name, value)
    return device
