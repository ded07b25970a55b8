"""The complete state of a component as plain numbers and names, which JSON keeps exactly."""

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import fields
from math import inf, tau
from sys import float_info
from typing import Any

from . import refusal_texts
from .contact import BACKWARD, FORWARD, LIFTED
from .moment import Moment
from .resolved import MARK_TOLERANCE
from .values import Refusal, is_finite_number

FORMAT = f"{__name__.rpartition('.')[0]} state"
"""The package inside an FMU is named after its content, so this names the build: a state of one
build does not fit another."""

PHASE = (-MARK_TOLERANCE, tau)
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


def number(name: str, value: object, kind: object = float) -> Any:
    """Return a number of a stored state, of type `kind`. Raises Refusal for anything else."""
    low, high = LIMITS.get(name, (-float_info.max, float_info.max))
    if isinstance(value, (int, float)) and low <= value <= high:
        if kind is float and (is_finite_number(value) or value == inf):
            return float(value)
        if type(value) is kind:
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


def moment_from_plain(plain: object) -> Moment:
    """The moment of which `asdict` made `plain`. Raises Refusal for odd or unknown entries."""
    stored = entries("moment", plain, [field.name for field in fields(Moment)])
    return Moment(*[number(f.name, stored[f.name], f.type) for f in fields(Moment)])


def entries(name: str, plain: object, names: Iterable[str]) -> Mapping[str, Any]:
    """Return a part of a stored state. Raises Refusal if its entries are not just `names`."""
    if not isinstance(plain, Mapping):
        text = "FMU state refused: {name} = {value}; must be an object with entries"
        raise Refusal(text, name=name, value=repr(plain))
    odd = sorted(plain.keys() ^ set(names))
    if odd:
        raise Refusal(
            "FMU state refused: entries of {name} that do not fit: {odd}", name=name, odd=odd
        )
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
