"""The complete state of a component as plain numbers and names, which JSON keeps exactly."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterable, Mapping
from dataclasses import fields
from math import inf
from typing import Any

from .contact import BACKWARD, FORWARD, LIFTED
from .moment import Counts, Moment
from .motion import State
from .orbit_state import (
    MAX_LEADS,
    MAX_TUNINGS,
    OpenError,
    OpenKind,
    OrbitState,
    OrbitValues,
    PaidTables,
    Stage,
    Swing,
    VisitedLeads,
)
from .period import PeriodMeans
from .refusal import Refusal
from .stops import Stops
from .values import flag, integer, integer_within, number, phase

FORMAT = f"{__name__.rpartition('.')[0]} state"
"""The package inside an FMU is named after its content, so this names the build: a state of one
build does not fit another."""

_PARTS_OF_ORBIT = ("swing", "under", "leads", "paid", "open")
_NUMBERS_OF_ORBIT = (
    "to_go",
    "waited",
    "velocity",
    "centre",
    "lead",
    "ahead",
    "doubt",
    "unrest",
    "acceleration",
)


def moment_to_plain(moment: Moment) -> dict[str, Any]:
    """Return the moment as nested dictionaries; before any event its age is None."""
    plain: dict[str, Any] = {f.name: getattr(moment, f.name) for f in fields(moment)}
    for name in ("state", "counts", "means", "stops"):
        plain[name] = plain[name]._asdict()
    plain["orbit"] = moment.orbit._asdict()
    for name in _PARTS_OF_ORBIT:
        plain["orbit"][name] = plain["orbit"][name]._asdict()
    if moment.event_age == inf:
        plain["event_age"] = None
    return plain


def moment_from_plain(plain: Mapping[str, Any]) -> Moment:
    """Invert `moment_to_plain`. Raises Refusal for entries that are missing, odd or unknown."""
    plain = entries("moment", plain, [f.name for f in fields(Moment)])
    state = entries("state", plain["state"], State._fields)
    counts = entries("counts", plain["counts"], Counts._fields)
    means = entries("means", plain["means"], PeriodMeans._fields)
    stops = entries("stops", plain["stops"], Stops._fields)
    age = plain["event_age"]
    return Moment(
        State(**{key: number(f"state.{key}", value) for key, value in state.items()}),
        number("position", plain["position"]),
        phase("theta", plain["theta"]),
        phase("psi", plain["psi"]),
        integer_within("mode", plain["mode"], BACKWARD, LIFTED),
        Counts(
            integer_within("counts.sliding", counts["sliding"], BACKWARD, FORWARD),
            integer("counts.reversals", counts["reversals"]),
            integer("counts.sticks", counts["sticks"]),
        ),
        inf if age is None else number("event_age", age),
        PeriodMeans(
            complete=flag("means.complete", means["complete"]),
            **{
                key: number(f"means.{key}", value)
                for key, value in means.items()
                if key != "complete"
            },
        ),
        number("bristle", plain["bristle"]),
        Stops(**{key: number(f"stops.{key}", value) for key, value in stops.items()}),
        _orbit_from_plain(plain["orbit"]),
    )


def _orbit_from_plain(plain: object) -> OrbitState:
    orbit = entries("orbit", plain, OrbitState._fields)
    visited = entries("leads", orbit["leads"], VisitedLeads._fields)
    visits = integer_within("orbit.leads.visits", visited["visits"], 0, MAX_LEADS + 1)

    def numbers(name: str, names: Iterable[str]) -> list[float]:
        part = entries(name, orbit[name], names)
        return [number(f"orbit.{name}.{key}", part[key]) for key in names]

    leads = [number(f"orbit.leads.{key}", visited[key]) for key in VisitedLeads._fields[1:]]
    return OrbitState(
        stage=integer_within("orbit.stage", orbit["stage"], Stage.AVERAGED, Stage.ON_ORBIT),
        **{key: number(f"orbit.{key}", orbit[key]) for key in _NUMBERS_OF_ORBIT},
        swing=Swing(*numbers("swing", Swing._fields)),
        under=OrbitValues(*numbers("under", OrbitValues._fields)),
        leads=VisitedLeads(visits, *leads),
        paid=_paid_from_plain(orbit["paid"]),
        tunings=integer_within("orbit.tunings", orbit["tunings"], 0, MAX_TUNINGS),
        open=_open_from_plain(orbit["open"]),
    )


def _open_from_plain(plain: object) -> OpenError:
    motion = entries("open", plain, OpenError._fields)
    kinds = OpenKind.NOTHING_OPEN, OpenKind.TAKEN_OVER
    return OpenError(
        integer_within("orbit.open.kind", motion["kind"], *kinds),
        *(number(f"orbit.open.{key}", motion[key]) for key in OpenError._fields[1:]),
    )


def _paid_from_plain(plain: object) -> PaidTables:
    paid = entries("paid", plain, PaidTables._fields)
    return PaidTables(
        curves=integer_within("orbit.paid.curves", paid["curves"], 0, MAX_LEADS),
        has_series=flag("orbit.paid.has_series", paid["has_series"]),
        **{
            key: number(f"orbit.paid.{key}", value)
            for key, value in paid.items()
            if key not in ("curves", "has_series")
        },
    )


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
