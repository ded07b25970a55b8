"""The complete state of a component as plain numbers and names, which JSON keeps exactly."""

import hashlib
import json
from collections.abc import Mapping
from dataclasses import asdict, dataclass, field
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


def to_plain(state: State) -> dict[str, Any]:
    """Return a snapshot of the state, of plain numbers and names."""
    return {"format": FORMAT, **asdict(state)}


def from_plain(plain: Mapping[str, Any]) -> State:
    """Return the state of a snapshot. Raises Refusal for one of another build, and for damage."""
    if plain["format"] != FORMAT:
        formats = {"found": plain["format"], "own": FORMAT}
        raise Refusal("FMU state refused: its format is {found!r}; must be {own!r}", **formats)
    stored = {name: entry for name, entry in plain.items() if name != "format"}
    stored["lifecycle"] = Lifecycle(stored["lifecycle"])
    stored["values"] = dict(stored["values"])
    stored["moment"] = stored["moment"] and Moment(**stored["moment"])
    return State(**stored)


def to_bytes(plain: Mapping[str, Any]) -> bytes:
    """Return a snapshot in bytes, after their checksum."""
    body = json.dumps(plain, sort_keys=True).encode()
    return _checksum(body) + b"\n" + body


def from_bytes(data: bytes) -> dict[str, Any]:
    """Invert `to_bytes`. Bytes that are not a snapshot become one whose format says so.

    It raises nothing, because there is no instance yet that could report an error. Setting such a
    snapshot is refused.
    """
    checksum, _, body = data.partition(b"\n")
    if checksum != _checksum(body):
        return {"format": f"damaged: {len(data)} bytes that do not match their checksum"}
    plain: dict[str, Any] = json.loads(body)
    return plain


def _checksum(body: bytes) -> bytes:
    return hashlib.sha256(body).hexdigest().encode()
