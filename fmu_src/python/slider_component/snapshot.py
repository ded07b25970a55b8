"""The complete state of a component as plain numbers and names, which JSON keeps exactly."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from enum import StrEnum
from math import inf
from typing import Any

from .moment import Moment
from .values import SETTABLE, Refusal, checked

FORMAT = f"{__name__.rpartition('.')[0]} state"
"""The package inside an FMU is named after its content, so this names the build: a state of one
build does not fit another."""


class Lifecycle(StrEnum):
    """State of an instance, by FMI's names."""

    INSTANTIATED = "instantiated"
    INITIALIZATION = "initialization mode"
    STEP_COMPLETE = "step complete"
    TERMINATED = "terminated"


@dataclass(slots=True)
class State:
    """The complete state of a component: times [s], the values that can be set, and the motion.

    `stop_time` is infinite where it is open. There is no `moment` before initialization ends.
    """

    lifecycle: Lifecycle = Lifecycle.INSTANTIATED
    time: float = 0.0
    stop_time: float = inf
    values: dict[str, float] = field(
        default_factory=lambda: {v.name: checked(v, v.start) for v in SETTABLE}
    )
    moment: Moment | None = None


def from_plain(plain: Mapping[str, Any]) -> State:
    """Return the state of a snapshot. Raises Refusal for one of another build, and for damage."""
    if plain["format"] != FORMAT:
        text = "FMU state refused: its format is {found!r}; must be {own!r}"
        raise Refusal(text, found=plain["format"], own=FORMAT)
    lifecycle, moment = Lifecycle(plain["lifecycle"]), plain["moment"]
    moment = None if moment is None else Moment(**moment)
    return State(lifecycle, plain["time"], plain["stop_time"], dict(plain["values"]), moment)


def to_bytes(plain: Mapping[str, Any]) -> bytes:
    """Return a snapshot in bytes, after their checksum."""
    body = json.dumps(plain, sort_keys=True).encode()
    return hashlib.sha256(body).hexdigest().encode() + b"\n" + body


def from_bytes(data: bytes) -> dict[str, Any]:
    """Invert `to_bytes`. Other bytes become a snapshot whose format says so: setting it is refused.

    Nothing is raised here: there is no instance yet that could report an error.
    """
    checksum, _, body = data.partition(b"\n")
    if checksum != hashlib.sha256(body).hexdigest().encode():
        return {"format": f"damaged: {len(data)} bytes that do not match their checksum"}
    plain: dict[str, Any] = json.loads(body)
    return plain
