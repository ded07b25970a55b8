"""What all tables of a scene file have in common: keys, numbers, devices."""

from __future__ import annotations

from typing import Annotated

from pydantic import BaseModel, ConfigDict, Field

from slider_resonator.device.interface import PARAMETERS
from slider_resonator.device.values import check_value
from slider_resonator.errors import unknown_name

Number = Annotated[float, Field(strict=True, allow_inf_nan=False)]
Positive = Annotated[float, Field(strict=True, allow_inf_nan=False, gt=0.0)]
NotNegative = Annotated[float, Field(strict=True, allow_inf_nan=False, ge=0.0)]
Point = tuple[Number, Number]


class KeyTable(BaseModel):
    """A table of a scene file; a key that it does not list is refused."""

    model_config = ConfigDict(extra="forbid", frozen=True)


def exactly_one(table: str, given: list[str], choices: str) -> None:
    """Raise ValueError unless one key is given of those that exclude each other."""
    if len(given) != 1:
        raise ValueError(f"{table} needs exactly one of {choices}, has {given or 'none'}")


def checked_device(device: dict[str, float]) -> dict[str, float]:
    """Return the parameters; ValueError for an unknown name or an impossible value."""
    for name, value in device.items():
        if name not in PARAMETERS:
            raise ValueError(unknown_name("parameter", name, PARAMETERS))
        check_value(name, value)
    return device
