"""What all tables of a scene file have in common: keys, numbers, devices."""

from collections.abc import Iterable, Mapping
from functools import partial
from typing import TYPE_CHECKING, Annotated, Any, ClassVar, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, create_model, model_validator

from slider_resonator.device.interface import INTEGERS, VARIABLES

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0.0)]
NotNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0)]
Line = Annotated[str, Field(min_length=1)]
Point = tuple[Number, Number]

HAS_UNIT = "[A-DF-Za-df-zµμ°%]"
"""A character that a text has which is a number with a unit, and one without does not have."""
NUMBER_OR_TEXT: Mapping[str, Any] = {
    "type": ["number", "string"],
    "pattern": rf"^\s*[-+.\d].*{HAS_UNIT}",
}
"""The JSON schema of a number that may be a text with a unit."""

PARAMETER_MEANINGS: Mapping[str, str] = {
    "slider_mass": "mass of the slider, M",
    "resonator_mass": "mass of the resonator, m",
    "resonator_frequency": "angular natural frequency of the resonator on a fixed slider",
    "damping_ratio": "damping ratio of the resonator on a fixed slider",
    "normal_preload": "mean normal load of a face, N0",
    "normal_amplitude": "amplitude of the normal load of a face; above the mean the contact lifts",
    "base_amplitude": "amplitude of the base excitation, A",
    "drive_frequency": "angular frequency of the drive, w",
    "tangential_force": "amplitude of the direct drive of the slider",
    "friction_coefficient": "friction coefficient, mu",
    "friction_faces": "faces with friction: 2 for a clamped slider, 1 for one on a surface",
    "friction_law": "0 Coulomb, 1 LuGre",
    "bristle_stiffness": "LuGre: bristle stiffness per unit normal load",
    "bristle_damping": "LuGre: bristle damping per unit normal load",
    "fidelity": "0 slow motion, 1 slider with the resonator's steady force, 2 full device",
    "tolerance": "error of LuGre friction; error of leaps in the slow velocity over the fast one",
    "initial_position": "position at the start",
    "initial_velocity": "velocity at the start",
    "initial_resonator_displacement": "displacement of the resonator against the slider",
    "initial_resonator_velocity": "velocity of the resonator against the slider",
    "initial_bristle_deflection": "LuGre: bristle deflection at the start",
    "averaging_order": "fidelity 0: 1 averages, 2 leaps over periods; predictions alike",
}
"""The meaning of each parameter, in the order of the interface."""


class KeyTable(BaseModel):
    """A table of a scene file; a key that it does not list is refused.

    `rules` hold between its keys. Each group of `one_of` has exactly one, `some_of` at least one.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)
    rules: ClassVar[tuple[str, ...]] = ()
    one_of: ClassVar[tuple[tuple[str, ...], ...]] = ()
    some_of: ClassVar[tuple[str, ...]] = ()

    @model_validator(mode="after")
    def _given_together(self) -> Self:
        for group in self.one_of:
            given = ", ".join(self.given(group))
            if len(self.given(group)) != 1:
                raise ValueError(f"needs exactly one of {', '.join(group)}; has {given or 'none'}")
        if self.some_of and not self.given(self.some_of):
            raise ValueError(f"needs at least one of {', '.join(self.some_of)}")
        return self

    @property
    def stated(self) -> dict[str, Any]:
        """The values of the keys that the table has."""
        return self.model_dump(exclude_unset=True)

    def given(self, names: Iterable[str]) -> dict[str, Any]:
        """Return the values of those of these keys that have one, by name."""
        values = {name: getattr(self, name) for name in names}
        return {name: value for name, value in values.items() if value is not None}


def key(meaning: str, example: Any, *, default: Any = None, **schema: Any) -> Any:
    """Return the field of a key that may be left out; `example` is a value that it may have.

    `schema` is what else its JSON schema has, such as the `unit`.
    """
    return Field(default=default, description=meaning, examples=[example], json_schema_extra=schema)


required = partial(key, default=...)
"""The same of a key that must be given."""


def units_of(table: type[KeyTable]) -> dict[str, str]:
    """Return the units of the keys that have one."""
    extras = {name: field.json_schema_extra for name, field in table.model_fields.items()}
    return {
        n: str(extra["unit"])
        for n, extra in extras.items()
        if isinstance(extra, dict) and "unit" in extra
    }


def _parameter(value: object, name: str) -> float:
    """Return the value of a parameter in its SI unit; ValueError says what an Integer means."""
    try:
        return VARIABLES[name].read(value)
    except ValueError as error:
        meaning = f" ({PARAMETER_MEANINGS[name]})" if name in INTEGERS else ""
        raise ValueError(f"{error}{meaning}") from error


def _field(name: str) -> Any:
    """Return the field of a parameter, which may be left out."""
    one = VARIABLES[name]
    about = {"default": one.start, "minimum": one.minimum, "maximum": one.maximum}
    given = {key: value for key, value in about.items() if value is not None}
    kind = int if name in INTEGERS else float
    return (
        Annotated[kind, BeforeValidator(partial(_parameter, name=name))],
        key(PARAMETER_MEANINGS[name], one.start, unit=one.unit, **given),
    )


if TYPE_CHECKING:
    ParametersTable = KeyTable
else:
    ParametersTable = create_model(
        "ParametersTable", __base__=KeyTable, **{name: _field(name) for name in PARAMETER_MEANINGS}
    )
"""Device parameters, in SI units or with a unit."""
