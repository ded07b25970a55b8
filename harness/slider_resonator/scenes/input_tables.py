"""The tables of a scene file with values over time: inputs and tuning."""

from typing import ClassVar, Literal

from pydantic import model_validator

from slider_resonator.scenes.key_table import KeyTable, Number, Point, key


class InputTable(KeyTable):
    """Values over time: a number alone, or a table with steps, a ramp or a CSV file."""

    rules: ClassVar[tuple[str, ...]] = (
        "Exactly one of a number, `steps`, `ramp` and `csv`. `phase = 0.4` is short for "
        "`phase = { constant = 0.4 }`.",
        "Times count from the start of the run and increase strictly. Before the first and after "
        "the last point of `steps` and `ramp` the value is theirs.",
        "A CSV file has a header and begins with the column `time`. It must have values from 0 to "
        "the end of the run: a run that goes beyond them is refused.",
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

    phase: InputTable = key(
        "phase of the normal force against the drive",
        0.4,
        unit="rad",
        default=InputTable(constant=0.0),
    )
    load: InputTable = key(
        "external force against motion in +X",
        {"steps": [[0.0, 0.0], [0.05, 0.04]]},
        unit="N",
        default=InputTable(constant=0.0),
    )
    frequency_ratio: InputTable = key(
        "frequency of the normal force over that of the drive",
        {"ramp": [[0.0, 1.0], [0.1, 1.01]]},
        unit="1",
        default=InputTable(constant=1.0),
    )
    amplitude_deviation: InputTable | None = key(
        "deviation of base_amplitude and tangential_force, relative to these; -1 is no drive",
        {"steps": [[0.0, 0.0], [0.05, -1.0]]},
        unit="1",
    )
    frequency_deviation: InputTable | None = key(
        "deviation of drive_frequency, relative to it", 0.01, unit="1"
    )


class TuningTable(KeyTable):
    """Tunable parameters over time, given as inputs are; those left out stay as in [device]."""

    rules: ClassVar[tuple[str, ...]] = (
        "A parameter is in [device] or in [tuning]; [tuning] needs a [run].",
        "Its value at the start of the run is that of the device.",
    )

    normal_preload: InputTable | None = key(
        "mean normal load of a face", {"steps": [[0.0, 1.0], [0.02, 1.4]]}, unit="N"
    )
    normal_amplitude: InputTable | None = key(
        "amplitude of the normal load of a face", {"ramp": [[0.0, 1.0], [0.1, 0.5]]}, unit="N"
    )
    base_amplitude: InputTable | None = key(
        "amplitude of the base excitation", {"steps": [[0.0, 1e-4], [0.05, 2e-4]]}, unit="m"
    )
    drive_frequency: InputTable | None = key(
        "angular frequency of the drive", {"steps": [[0.0, 3500.0], [0.05, 3600.0]]}, unit="rad/s"
    )
    tangential_force: InputTable | None = key("amplitude of the direct drive", 0.5, unit="N")
    friction_coefficient: InputTable | None = key(
        "friction coefficient", {"csv": "friction.csv", "column": "mu"}, unit="1"
    )
