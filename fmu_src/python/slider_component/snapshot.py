"""The complete state of a component as plain numbers and names, which JSON keeps exactly."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable, Mapping
from dataclasses import fields
from functools import partial
from math import inf
from typing import Any

from .contact import BACKWARD, FORWARD, LIFTED
from .moment import Moment
from .values import Refusal, flag, integer, integer_within, number, phase

FORMAT = f"{__name__.rpartition('.')[0]} state"
"""The package inside an FMU is named after its content, so this names the build: a state of one
build does not fit another."""

CHECKS: dict[str, Callable[[str, object], Any]] = {
    "theta": phase,
    "psi": phase,
    "mode": partial(integer_within, minimum=BACKWARD, maximum=LIFTED),
    "sliding": partial(integer_within, minimum=BACKWARD, maximum=FORWARD),
    "reversals": integer,
    "sticks": integer,
    "complete": flag,
}
"""What entries of a moment must be that are not just finite numbers."""


def moment_to_plain(moment: Moment) -> dict[str, Any]:
    """Return the moment as a dictionary; before any event its age is None."""
    plain = {field.name: getattr(moment, field.name) for field in fields(moment)}
    return plain | ({"event_age": None} if moment.event_age == inf else {})


def moment_from_plain(plain: object) -> Moment:
    """Invert `moment_to_plain`. Raises Refusal for entries that are missing, odd or unknown."""
    names = [field.name for field in fields(Moment)]
    stored = dict(entries("moment", plain, names))
    no_event = stored["event_age"] is None
    if no_event:
        stored["event_age"] = 0.0
    moment = Moment(*[CHECKS.get(name, number)(name, stored[name]) for name in names])
    if no_event:
        moment.event_age = inf
    return moment


def entries(name: str, plain: object, names: Iterable[str]) -> Mapping[str, Any]:
    """Return a part of a stored state. Raises Refusal if its entries are not just `names`."""
    if not isinstance(plain, Mapping):
        raise Refusal(f"FMU state refused: {name} = {plain!r}; must be an object with entries")
    odd = plain.keys() ^ set(names)
    if odd:
        raise Refusal(f"FMU state refused: entries of {name} that do not fit: {sorted(odd)!r}")
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
