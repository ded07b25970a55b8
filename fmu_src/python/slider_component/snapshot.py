"""The complete state of a component as plain numbers and names, which JSON keeps exactly."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import fields
from math import inf
from typing import Any

from . import refusal_texts
from .contact import BACKWARD, LIFTED
from .moment import Counts, Moment
from .motion import State
from .period import PeriodMeans
from .refusal import Refusal
from .values import integer, number

FORMAT = f"{__name__.rpartition('.')[0]} state"
"""The package inside an FMU is named after its content, so this names the build: a state of one
build does not fit another."""


def moment_to_plain(moment: Moment) -> dict[str, Any]:
    """Return the moment as nested dictionaries; before any event its age is None."""
    plain: dict[str, Any] = {f.name: getattr(moment, f.name) for f in fields(moment)}
    for name in ("state", "counts", "means"):
        plain[name] = plain[name]._asdict()
    if moment.event_age == inf:
        plain["event_age"] = None
    return plain


def moment_from_plain(plain: Mapping[str, Any]) -> Moment:
    """Invert `moment_to_plain`. Raises Refusal for a missing entry or one that is not a number."""
    try:
        age = plain["event_age"]
        means = dict(plain["means"])
        complete = means.pop("complete")
        moment = Moment(
            State(**_numbers("state", plain["state"])),
            number("position", plain["position"]),
            number("theta", plain["theta"]),
            number("psi", plain["psi"]),
            integer("mode", plain["mode"]),
            Counts(**{name: integer(name, value) for name, value in plain["counts"].items()}),
            inf if age is None else number("event_age", age),
            PeriodMeans(complete=bool(complete), **_numbers("means", means)),
            number("bristle", plain["bristle"]),
        )
    except (KeyError, TypeError, AttributeError) as error:
        raise Refusal(f"FMU state refused: its motion does not fit ({error!r})") from error
    if not BACKWARD <= moment.mode <= LIFTED:
        raise Refusal(refusal_texts.out_of_range_in_state("mode", moment.mode, BACKWARD, LIFTED))
    return moment


def _numbers(name: str, plain: Mapping[str, Any]) -> dict[str, float]:
    return {key: number(f"{name}.{key}", value) for key, value in plain.items()}


def to_bytes(plain: Mapping[str, Any]) -> bytes:
    """Return a snapshot in bytes, after their checksum."""
    body = json.dumps(plain, sort_keys=True).encode()
    return _checksum(body) + b"\n" + body


def from_bytes(data: bytes) -> dict[str, Any]:
    """Invert `to_bytes`. Bytes that are not a snapshot become one whose format says so.

    Never raises: there is no instance here that could survive an error. To set such a snapshot is
    refused.
    """
    checksum, _, body = data.partition(b"\n")
    if checksum != _checksum(body):
        return {"format": f"damaged: {len(data)} bytes that do not match their checksum"}
    try:
        plain = json.loads(body)
    except ValueError as error:
        return {"format": f"unreadable: {error}"}
    return plain if isinstance(plain, dict) else {"format": type(plain).__name__}


def _checksum(body: bytes) -> bytes:
    return hashlib.sha256(body).hexdigest().encode()
