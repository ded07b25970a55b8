"""The complete state of a component as plain numbers and names, which JSON keeps exactly."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import asdict, dataclass, field, fields
from enum import StrEnum
from math import inf, tau
from sys import float_info
from typing import Any

from . import refusal_texts
from .contact import BACKWARD, FORWARD, LIFTED
from .moment import Moment
from .resolved import PERIOD_END_TOLERANCE
from .values import BY_NAME, SETTABLE, Refusal, checked

FORMAT = f"{__name__.rpartition('.')[0]} state"
"""The package inside an FMU is named after its content, so this names the build: a state of one
build does not fit another."""

PHASE = (-PERIOD_END_TOLERANCE, tau)
"""A phase [rad]: a period may count as ended before its end, and rounding may take one up to it."""

LIMITS: dict[str, tuple[float, float]] = {
    "theta": PHASE,
    "psi": PHASE,
    "mode": (BACKWARD, LIFTED),
    "sliding": (BACKWARD, FORWARD),
    "reversals": (0, 2**53),
    "sticks": (0, 2**53),
    "complete": (0, 1),
    "event_age": (-float_info.max, inf),
    "stop_time": (-float_info.max, inf),
}
"""Least and largest value of entries that are not any finite number."""


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
    last_event_time: float = 0.0
    values: dict[str, float] = field(
        default_factory=lambda: {v.name: checked(v, v.start) for v in SETTABLE}
    )
    moment: Moment | None = None


def to_plain(state: State) -> dict[str, Any]:
    """Return a snapshot of the state, of plain numbers and names."""
    return {"format": FORMAT, **asdict(state)}


def from_plain(plain: object) -> State:
    """Return the state of a snapshot. Raises Refusal for anything else."""
    try:
        return _state(plain)
    except RecursionError:
        raise Refusal("FMU state refused: its entries are nested too deeply") from None


def _state(plain: object) -> State:
    stored_format = plain.get("format") if isinstance(plain, Mapping) else type(plain).__name__
    if stored_format != FORMAT:
        formats = {"found": repr(stored_format), "own": FORMAT}
        raise Refusal("FMU state refused: its format is {found}; must be {own!r}", **formats)
    stored = _entries("the state", plain, ["format", *(f.name for f in fields(State))])
    try:
        lifecycle = Lifecycle(stored["lifecycle"])
    except ValueError as error:
        raise Refusal("FMU state refused: {error}", error=error) from error
    times = {name: _number(name, stored[name]) for name in ("time", "stop_time", "last_event_time")}
    values = _entries("values", stored["values"], [v.name for v in SETTABLE])
    values = {name: checked(BY_NAME[name], value) for name, value in values.items()}
    moment = None
    if stored["moment"] is not None:
        numbers = _entries("moment", stored["moment"], [f.name for f in fields(Moment)])
        moment = Moment(*(_number(f.name, numbers[f.name], f.type) for f in fields(Moment)))
    elif lifecycle in (Lifecycle.STEP_COMPLETE, Lifecycle.TERMINATED):
        raise Refusal("FMU state refused: it holds no motion; must be one after initialization")
    return State(lifecycle, **times, values=values, moment=moment)


def _number(name: str, value: object, kind: object = float) -> Any:
    """Return a number of a stored state, of type `kind`. Raises Refusal for anything else."""
    low, high = LIMITS.get(name, (-float_info.max, float_info.max))
    if type(value) is kind and low <= value <= high:  # type: ignore[operator]
        return value
    shown = {"name": name, "value": repr(value)}
    if kind is bool:
        raise Refusal("FMU state refused: {name} = {value}; must be true or false", **shown)
    if kind is int:
        limits = {"minimum": int(low), "maximum": int(high)}
        raise Refusal(refusal_texts.OUT_OF_RANGE_IN_STATE, **shown, **limits)
    is_phase = (low, high) == PHASE
    raise Refusal(
        refusal_texts.PHASE_IN_STATE if is_phase else refusal_texts.INFINITE_IN_STATE, **shown
    )


def _entries(name: str, plain: object, names: Iterable[str]) -> Mapping[str, Any]:
    """Return a part of a stored state. Raises Refusal if its entries are not just `names`."""
    if not isinstance(plain, Mapping):
        text = "FMU state refused: {name} = {value}; must be an object with entries"
        raise Refusal(text, name=name, value=repr(plain))
    odd = sorted(plain.keys() ^ set(names))
    if odd:
        text = "FMU state refused: entries of {name} that do not fit: {odd}"
        raise Refusal(text, name=name, odd=odd)
    return plain


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
    try:
        plain = json.loads(body)
    except (ValueError, RecursionError) as error:
        return {"format": f"unreadable: {error}"}
    return plain if isinstance(plain, dict) else {"format": type(plain).__name__}


def _checksum(body: bytes) -> bytes:
    return hashlib.sha256(body).hexdigest().encode()
