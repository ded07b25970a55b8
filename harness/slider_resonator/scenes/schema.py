"""The schema of a scene file. Every key is listed in its tables; any other is refused."""

from collections.abc import Mapping
from math import isfinite
from typing import Annotated, Any, ClassVar, Literal

from pydantic import Field, field_validator, model_validator

from slider_resonator.device.interface import SETTABLE, TUNABLES, VARIABLES, settable_value
from slider_resonator.errors import unknown_name
from slider_resonator.scenes.expansion import with_bundles
from slider_resonator.scenes.key_table import (
    PARAMETER_MEANINGS,
    KeyTable,
    Line,
    NotNegative,
    Number,
    ParametersTable,
    Point,
    Positive,
    key,
    required,
)
from slider_resonator.scenes.needs import NeedTable
from slider_resonator.scenes.vocabulary import MAX_TUBE, QUANTITIES, REFERENCES, Quantity


class InputTable(KeyTable):
    """Values over time: a number alone, or a table with steps, a ramp or a CSV file."""

    rules: ClassVar[tuple[str, ...]] = (
        "Exactly one of a number, `steps`, `ramp` and `csv`. `phase = 0.4` is short for "
        "`phase = { constant = 0.4 }`.",
        "Times count from the start of the run and increase strictly. Before the first and after "
        "the last point of `steps` and `ramp` the value is theirs.",
        "A CSV file has a header and begins with the column `time`. It must have values from 0 to "
        "the end of the run: a run that goes beyond them is refused. A heading may have a unit in "
        "brackets: `load [mN]`.",
        "`column` and `between` belong to a `csv`.",
        "A jump is a communication point: no step goes over it.",
        "Straight lines are sampled at communication points and held until the next, unless [run] "
        "says `interpolate`.",
    )

    one_of = (("constant", "steps", "ramp", "csv"),)

    constant: Number | None = key("value throughout the run", 0.4)
    steps: tuple[Point, ...] | None = key(
        "[time (s), value] pairs; each value holds until the next", [[0.0, 0.0], [0.05, 0.04]]
    )
    ramp: tuple[Point, ...] | None = key(
        "[time (s), value] pairs, joined by straight lines", [[0.0, 0.0], [0.1, 0.4]]
    )
    csv: str | None = key("file with the points, its path relative to the scene", "load.csv")
    column: str | None = key(
        "column with the values; without it the one called as the input, or else `value`", "load"
    )
    between: Literal["linear", "hold"] = key(
        "between the rows: straight lines, or each value until the next", "hold", default="linear"
    )

    @model_validator(mode="before")
    @classmethod
    def _plain_number(cls, value: object) -> object:
        return value if isinstance(value, dict) else {"constant": value}

    @model_validator(mode="after")
    def _only_of_a_csv(self) -> "InputTable":
        if self.csv is None and self.model_fields_set & {"column", "between"}:
            raise ValueError("column and between belong to a csv")
        return self


class InputsTable(KeyTable):
    """The inputs of the FMU; those left out keep their start value."""

    rules: ClassVar[tuple[str, ...]] = (
        "Deviations of the drive are held over a step, in a run that says `interpolate`, too.",
    )

    phase: InputTable | None = key("phase of the normal force against the drive", 0.4, unit="rad")
    load: InputTable | None = key(
        "external force against motion in +X", {"steps": [[0.0, 0.0], [0.05, 0.04]]}, unit="N"
    )
    frequency_ratio: InputTable | None = key(
        "frequency of the normal force over that of the drive",
        {"ramp": [[0.0, 1.0], [0.1, 1.01]]},
        unit="1",
    )
    amplitude_deviation: InputTable | None = key(
        "deviation of base_amplitude and tangential_force, relative to these; -1 is no drive",
        {"steps": [[0.0, 0.0], [0.05, -1.0]]},
        unit="1",
    )
    frequency_deviation: InputTable | None = key(
        "deviation of drive_frequency, relative to it", 0.01, unit="1"
    )


def _tuned(name: str, example: Any) -> Any:
    return key(PARAMETER_MEANINGS[name], example, unit=VARIABLES[name].unit)


class TuningTable(KeyTable):
    """Tunable parameters over time, given as inputs are; those left out stay as in [device]."""

    rules: ClassVar[tuple[str, ...]] = (
        "A parameter is in [device] or in [tuning]; [tuning] needs a [run].",
        "Its value at the start of the run is that of the device.",
    )

    normal_preload: InputTable | None = _tuned("normal_preload", {"steps": [[0, 1], [0.02, 1.4]]})
    normal_amplitude: InputTable | None = _tuned("normal_amplitude", {"ramp": [[0, 1], [0.1, 0.5]]})
    base_amplitude: InputTable | None = _tuned("base_amplitude", {"ramp": [[0, 1e-4], [1, 2e-4]]})
    drive_frequency: InputTable | None = _tuned("drive_frequency", {"ramp": [[0, 3500], [1, 3600]]})
    tangential_force: InputTable | None = _tuned("tangential_force", 0.5)
    friction_coefficient: InputTable | None = _tuned("friction_coefficient", {"csv": "mu.csv"})


class RunTable(KeyTable):
    """How long the scene runs and in which communication steps, in seconds or drive periods."""

    rules: ClassVar[tuple[str, ...]] = (
        "Exactly one of `stop_time` and `drive_periods`.",
        "Exactly one of `step_size`, `steps_per_period` and `step_sizes`.",
        "A run has at most 3 000 000 steps.",
        "Without `interpolate` inputs are sampled at each communication point and held until the "
        "next, in any FMU. With it their corners are communication points, too; what is expected "
        "of the run does not apply to an FMU without `canInterpolateInputs`.",
        "References with the fast motion follow any line under which `frequency_ratio` keeps its "
        "sign, `averaged` lines of `phase` and `load`.",
        "Without [run] only quantities of the steady motion can be expected.",
    )

    one_of = (("stop_time", "drive_periods"), ("step_size", "steps_per_period", "step_sizes"))

    stop_time: Positive | None = key("length of the run", 0.1, unit="s")
    drive_periods: Positive | None = key("length of the run", 100.0, unit="drive periods")
    step_size: Positive | None = key("communication step", 1e-3, unit="s")
    steps_per_period: Positive | None = key("communication steps in a drive period", 8.0)
    step_sizes: Annotated[tuple[Positive, ...], Field(min_length=1)] | None = key(
        "communication steps that follow each other over and over; the last ends at the stop",
        [1e-9, 2e-4, 7e-3],
        unit="s",
    )
    start_time: Number = key(
        "time at which the FMU starts; all other times of a scene count from there",
        1e4,
        unit="s",
        default=0.0,
    )
    read_twice: Annotated[bool, Field(strict=True)] = key(
        "also read outputs after values change, before the step, and compare both",
        True,
        default=False,
    )

    interpolate: Annotated[bool, Field(strict=True)] = key(
        "pass straight lines of inputs on, as derivatives: `ramp`, and `csv` with `between` linear",
        True,
        default=False,
    )


class ExpectTable(KeyTable):
    """One expectation: a quantity of the FMU against a reference, a value or a bound."""

    rules: ClassVar[tuple[str, ...]] = (
        "Exactly one of `reference`, `value`, `at_most` and `at_least`. A signal needs a "
        "reference, a word a `value`; only numbers have bounds.",
        "The allowed deviation of a number is `absolute + relative * |reference|`. Without "
        "`absolute` a reference counts as no smaller than a hundredth of its natural scale: v_q, "
        "full friction, the fast amplitude.",
        "The allowed deviation of a signal is `relative`, a share of the reference's peak; "
        "`absolute` beside it is for a reference near zero.",
        "A real number needs a tolerance, be it 0; counts, words and contact modes need none.",
        "`tube` allows a signal to be early or late, with the references `located_events` "
        "and `bristle_state`. For `event_times` it is the tolerance, alone.",
        "`quantity` may be a list of names, which is short for an [[expect]] of each.",
        "`absolute = 0.001` with a unit of m means 1 mm: all values are in the unit of the "
        "quantity.",
    )

    one_of = (("reference", "value", "at_most", "at_least"),)

    quantity: str = required(
        "what is compared; the list is below", "position", enum=list(QUANTITIES)
    )
    reference: str | None = key(
        "reference that gives the expected value; which the quantity has is below",
        "located_events",
        enum=list(REFERENCES),
    )
    value: float | str | None = key("expected number or word", 0.126667)
    at_most: Number | None = key("upper bound of a number", 100.0)
    at_least: Number | None = key("lower bound of a number", 0.12)
    absolute: NotNegative = key("allowed deviation", 1e-9, unit="unit of the quantity", default=0.0)
    relative: NotNegative = key("allowed deviation, as a share", 1e-8, unit="1", default=0.0)
    tube: Annotated[float, Field(strict=True, gt=0.0, lt=MAX_TUBE)] | None = key(
        "allowed shift in time", 0.01, unit="drive periods"
    )
    why: Line = required(
        "the reason for the expectation, for the report", "the step must arrive when it is due"
    )

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
    def _comparable(self) -> "ExpectTable":
        given = [*self.given(self.one_of[0])]
        quantity = QUANTITIES[self.quantity]
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
        given = self.model_fields_set & {"absolute", "relative"}
        if quantity.in_periods:
            if self.tube is None or given:
                raise ValueError(f"{self.quantity} needs a tube, a share of the period, alone")
            return
        if self.tube is not None and self.reference not in quantity.tube_references:
            by = " or ".join(quantity.tube_references)
            only = f"only against {by}" if by else "with no reference: delete the key"
            raise ValueError(f"tube = {self.tube!r}: {self.quantity} can have one {only}")
        signal = quantity.kind == "signal"
        alone = quantity.exact or not self.relative > 0.0
        if signal and "absolute" in given and alone:
            raise ValueError(f"{self.quantity} is a signal: must be relative, not absolute alone")
        if not quantity.exact and not given:
            needed = "relative, a share of the peak" if signal else "relative or absolute"
            raise ValueError(f"{self.quantity} is a real number: it needs a tolerance, {needed}")


class SweepTable(KeyTable):
    """One parameter or input and its values; every expectation must hold at each."""

    rules: ClassVar[tuple[str, ...]] = (
        "At least one value. Without the sweep the variable must be constant in the run.",
    )

    variable: str = required("the parameter or input that varies", "load", enum=[*SETTABLE])
    values: Annotated[tuple[Number, ...], Field(min_length=1)] = required(
        "its values", [0.0, 0.02, 0.04]
    )

    @model_validator(mode="after")
    def _possible(self) -> "SweepTable":
        for value in self.values:
            settable_value(self.variable, value)
        return self


class DeviceFileTable(KeyTable):
    """A whole device file."""

    name: str = ""
    title: str = ""
    description: str = ""
    device: ParametersTable = required(
        "parameters that differ from table 1", {"friction_coefficient": 0.12}
    )


class SceneTable(KeyTable):
    """A whole scene file."""

    rules: ClassVar[tuple[str, ...]] = (
        "Only `name` and `title` are needed. Any key that is not listed is refused.",
        'Numbers are in SI units. A text may have another unit: "20 kHz", "30 deg", "5 ms".',
        "A file with [[variant]] tables is several scenes: each has what the file says, and on top "
        "of it what its variant says, key by key. A variant needs a name of its own.",
        "An [[expect]] replaces that of a bundle, and that of a variant one of the file, with the "
        "same quantity and reference. What it leaves out is that of the one that it replaces.",
    )

    name: str = Field(
        pattern=r"^[A-Za-z0-9_\-]+$",
        description="name in reports: letters, digits, _ and -",
        examples=["my_step"],
    )
    title: Line = required("one line for lists and plots", "The load steps up")
    description: str = key("what the scene shows, and why", "A step of load.", default="")
    device: ParametersTable = key(
        "parameters that differ from table 1",
        {"friction_coefficient": 0.12},
        default=ParametersTable(),
    )
    inputs: InputsTable = key("inputs over time", {"phase": 0.4}, default=InputsTable())
    tuning: TuningTable = key(
        "tunable parameters that change in the run",
        {"normal_preload": {"steps": [[0.0, 1.0], [0.02, 1.4]]}},
        default=TuningTable(),
    )
    run: RunTable | None = key("length and steps", {"stop_time": 0.1, "step_size": 1e-3})
    expect_bundles: tuple[str, ...] = key(
        "bundles of expectations; they are listed below", ["motion"], default=()
    )
    expect: tuple[ExpectTable, ...] = key(
        "what must hold; each is headed [[expect]]",
        [{"quantity": "reversals", "value": 200, "why": "two in each period"}],
        default=(),
    )
    sweep: SweepTable | None = key(
        "values of one variable; every expectation must hold at each",
        {"variable": "load", "values": [0.0, 0.02]},
    )
    need: NeedTable | None = key(
        "accuracy that the command choose meets", {"position": {"abs": 2e-3}}
    )

    variant: tuple[Mapping[str, Any], ...] = key(
        "the scenes of a file of several; each is headed [[variant]]",
        [{"name": "my_fast_step", "title": "The step in 1 ms", "run": {"step_size": 1e-3}}],
        default=(),
    )

    @model_validator(mode="before")
    @classmethod
    def _with_bundles(cls, content: Mapping[str, Any]) -> Mapping[str, Any]:
        return with_bundles(content)

    @model_validator(mode="after")
    def _tuned_once(self) -> "SceneTable":
        for name in self.tuning.given(TUNABLES):
            if name in self.device.model_fields_set:
                raise ValueError(
                    f"tuning.{name} is in [device] and in [tuning]; must be in one of them"
                )
        return self
