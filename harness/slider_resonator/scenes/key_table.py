"""What all tables of a scene file have in common: keys, numbers, devices."""

from __future__ import annotations

from typing import Annotated, Any, ClassVar

from pydantic import AfterValidator, BaseModel, ConfigDict, Field
from pydantic_core import PydanticCustomError

from slider_resonator.device.device import DEVIATIONS
from slider_resonator.device.interface import INPUTS, INTEGERS, PARAMETERS
from slider_resonator.device.values import check_value
from slider_resonator.errors import unknown_name
from slider_resonator.scenes.device_keys import PARAMETER_MEANINGS, device_schema

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0.0)]
NotNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0)]
Line = Annotated[str, Field(min_length=1)]
Point = tuple[Number, Number]


NAMED = "named"
"""The type of an error whose text begins with the key in the table where it is found."""


class KeyTable(BaseModel):
    """A table of a scene file; a key that it does not list is refused.

    `rules` are those that hold between its keys.
    """

    model_config = ConfigDict(extra="forbid", frozen=True)
    rules: ClassVar[tuple[str, ...]] = ()


def key(meaning: str, example: Any, *, unit: str = "", default: Any = None) -> Any:
    """Return the field of a key that may be left out; `example` is a value that it may have."""
    unit_of: dict[str, Any] = {"unit": unit} if unit else {}
    return Field(
        default=default, description=meaning, examples=[example], json_schema_extra=unit_of
    )


def required(meaning: str, example: Any) -> Any:
    """Return the field of a key that must be given, as `key` does."""
    return Field(description=meaning, examples=[example])


def units_of(table: type[KeyTable]) -> dict[str, str]:
    """Return the units of the keys that have one."""
    extras = {name: field.json_schema_extra for name, field in table.model_fields.items()}
    return {
        n: str(extra["unit"])
        for n, extra in extras.items()
        if isinstance(extra, dict) and "unit" in extra
    }


def exactly_one(table: str, given: list[str], choices: str) -> None:
    """Raise ValueError unless one key is given of those that exclude each other."""
    if len(given) != 1:
        raise ValueError(f"{table} needs exactly one of {choices}, has {given or 'none'}")


def checked_device(device: dict[str, float]) -> dict[str, float]:
    """Return the parameters; an error of kind `NAMED` for an unknown name or impossible value."""
    for name, value in device.items():
        try:
            if name in (*INPUTS, *DEVIATIONS):
                raise ValueError(f"{name}: is an input: must be in [inputs]")
            if name not in PARAMETERS:
                raise ValueError(f"{name}: {unknown_name('parameter', name, PARAMETERS)}")
            check_value(name, value)
        except ValueError as error:
            text = f"{error} ({PARAMETER_MEANINGS[name]})" if name in INTEGERS else str(error)
            raise PydanticCustomError(NAMED, "{text}", {"text": text}) from error
    return device


Parameters = Annotated[dict[str, Number], AfterValidator(checked_device)]
"""Device parameters by name."""


def parameters(meaning: str, example: Any) -> Any:
    """Return the field of a table of parameters, as `key` does."""
    return Field(
        default={},
        description=meaning,
        examples=[example],
        json_schema_extra=device_schema(),
    )
