"""The schema of a scene file. Every key is listed in its tables; any other is refused."""

from collections.abc import Mapping
from typing import Annotated, Any, ClassVar

from pydantic import Field, field_validator, model_validator

from slider_resonator.device.device import DEVIATIONS
from slider_resonator.device.interface import INPUTS, SETTABLE, TUNABLES
from slider_resonator.device.values import check_value
from slider_resonator.errors import unknown_name
from slider_resonator.scenes.expansion import with_bundles
from slider_resonator.scenes.expect_table import ExpectTable
from slider_resonator.scenes.input_tables import AllInputsTable, BesideTable, TuningTable
from slider_resonator.scenes.key_table import (
    KeyTable,
    Line,
    Number,
    Parameters,
    Positive,
    device_schema,
    exactly_one,
    key,
    required,
)
from slider_resonator.scenes.need_table import RUN_NEEDS, STEADY_NEEDS, NeedTable
from slider_resonator.scenes.vocabulary import QUANTITIES


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

    @model_validator(mode="after")
    def _one_of_each(self) -> "RunTable":
        lengths = ("stop_time", "drive_periods")
        for names in (lengths, ("step_size", "steps_per_period", "step_sizes")):
            exactly_one("run", [*self.given(names)], " or ".join(names))
        return self


class SweepTable(KeyTable):
    """One parameter or input and its values; every expectation must hold at each."""

    rules: ClassVar[tuple[str, ...]] = (
        "At least one value. Without the sweep the variable must be constant in the run.",
    )

    variable: str = required("the parameter or input that varies", "load", enum=[*SETTABLE])
    values: Annotated[tuple[Number, ...], Field(min_length=1)] = required(
        "its values", [0.0, 0.02, 0.04]
    )

    @field_validator("variable")
    @classmethod
    def _known_variable(cls, name: str) -> str:
        if name not in SETTABLE:
            raise ValueError(unknown_name("parameter or input", name, SETTABLE))
        return name

    @model_validator(mode="after")
    def _possible(self) -> "SweepTable":
        for value in self.values:
            check_value(self.variable, value)
        return self


class SceneTable(KeyTable):
    """A whole scene file."""

    rules: ClassVar[tuple[str, ...]] = (
        "Only `name` and `title` are needed. Any key that is not listed is refused.",
        'Numbers are in SI units. A text may have another unit: "20 kHz", "30 deg", "5 ms".',
        "A file with [[variant]] tables is several scenes: each has what the file says, and on top "
        "of it what its variant says, key by key. A variant needs a name and a title of its own.",
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
    device: Parameters = key(
        "parameters that differ from table 1",
        {"friction_coefficient": 0.12},
        default={},
        **device_schema(),
    )
    inputs: AllInputsTable = key("inputs over time", {"phase": 0.4}, default=AllInputsTable())
    tuning: TuningTable = key(
        "tunable parameters that change in the run",
        {"normal_preload": {"steps": [[0.0, 1.0], [0.02, 1.4]]}},
        default=TuningTable(),
    )
    beside: BesideTable | None = key("a second instance", {"device": {"damping_ratio": 0.02}})
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
    def _runnable(self) -> "SceneTable":
        for name in self.tuning.given(TUNABLES):
            if name in self.device:
                raise ValueError(
                    f"tuning.{name} is in [device] and in [tuning]; must be in one of them"
                )
            if self.run is None:
                raise ValueError(f"tuning.{name} is for a run: [run] is missing")
        if self.sweep and self.sweep.variable in self._changing():
            raise ValueError(
                f"sweep.variable = {self.sweep.variable!r}: changes in the run; must be one whose "
                "value is constant"
            )
        for expect in self.expect:
            quantity, key = QUANTITIES[expect.quantity], f"expect: {expect.quantity}"
            if quantity.needs_run and self.run is None:
                raise ValueError(f"{key} is measured in a run: [run] is missing")
            if quantity.needs_constants and self._changing():
                raise ValueError(f"{key} needs constant inputs and parameters")
            if quantity.needs_beside and self.beside is None:
                raise ValueError(f"{key} needs a second instance: [beside] is missing")
        for need in self.need.needs if self.need else ():
            if need in RUN_NEEDS and self.run is None:
                raise ValueError(f"need.{need} is measured in a run: [run] is missing")
            if need in STEADY_NEEDS and self._changing():
                raise ValueError(f"need.{need} needs constant inputs and parameters")
        return self

    def _changing(self) -> list[str]:
        """Return the names of the inputs and parameters that change in the run.

        Deviations of a drive that is tuned count as such: they are applied to what it is tuned to.
        """
        tuned, deviations = self.tuning.given(TUNABLES), self.inputs.given(DEVIATIONS)
        tables = self.inputs.given(INPUTS) | tuned | deviations
        combined = deviations if tuned else {}
        return [n for n, table in tables.items() if table.constant is None or n in combined]
