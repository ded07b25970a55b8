"""What the tables of held orbits cost, and which are paid for.

A table pays where motion stays with it. So inputs that ask for another one are followed by resolved
motion first, for as long as costs what the table does: whether they change soon or stay, motion
costs about twice the cheaper way at most. From the start on a lead that drifts is followed by
searches for as long. The state says what is paid for, as the tables are a cache.
"""

from __future__ import annotations

from math import tau

from .device import Device
from .orbit_ride import OrbitSource, orbit_phase_of, orbit_source_of
from .orbit_state import OrbitState

CURVE_TURNS = 400.0
"""Turns of the orbit whose resolved motion costs what a curve at one lead does: instructions
counted with table 1, under Coulomb friction."""

SERIES_TURNS = 4300.0
"""The same of the series over leads."""

SEARCH_TURNS = 160.0
"""The same of the searches after a change."""

BRISTLE_CURVE_TURNS = 450.0
"""The same of a curve under LuGre friction."""

BRISTLE_SERIES_TURNS = 4600.0
"""The same of the series."""

BRISTLE_SEARCH_TURNS = 600.0
"""The same of searches."""

ROUNDING = 1e-9
"""What rounding takes from a price that has been waited for."""


def orbit_price(
    device: Device, ratio: float, orbit: OrbitState, lead: float, *, changed: bool
) -> float:
    """Drive angle [rad] of resolved motion that costs what it does to go on at a lead [rad].

    0 where its tables are paid for. `changed` is whether the values differ from those of the last
    step.
    """
    slow = orbit_phase_of(device, ratio)
    coulomb, turns = device.friction_law == 0, 0.0
    source = _source_at(device, ratio, orbit, lead)
    if source == OrbitSource.CURVE:
        if not orbit.paid.has_curve(slow.waves, lead):
            turns = CURVE_TURNS if coulomb else BRISTLE_CURVE_TURNS
    elif source == OrbitSource.SEARCH:
        if changed:
            turns = SEARCH_TURNS if coulomb else BRISTLE_SEARCH_TURNS
    elif (changed or source == OrbitSource.COMBINED) and not orbit.paid.has_series_of(slow.waves):
        turns = SERIES_TURNS if coulomb else BRISTLE_SERIES_TURNS
    return tau * (slow.turns or 0) * turns


def with_paid(device: Device, ratio: float, orbit: OrbitState, lead: float) -> OrbitState:
    """The state when the tables of a lead [rad] are paid for."""
    source = _source_at(device, ratio, orbit, lead)
    waves = orbit_phase_of(device, ratio).waves
    if source == OrbitSource.CURVE:
        return orbit._replace(paid=orbit.paid.with_curve(waves, lead))
    if source == OrbitSource.SEARCH:
        return orbit
    return orbit._replace(paid=orbit.paid.with_series(waves))


def is_due(device: Device, ratio: float, orbit: OrbitState) -> bool:
    """Whether the motion that waited for its tables has cost as much as they do.

    That counts for the series over leads alone: until then orbits are searched.
    """
    slow = orbit_phase_of(device, ratio)
    price = SERIES_TURNS if device.friction_law == 0 else BRISTLE_SERIES_TURNS
    return slow.drift == 0.0 or orbit.waited >= tau * (slow.turns or 0) * price * (1.0 - ROUNDING)


def _source_at(device: Device, ratio: float, orbit: OrbitState, lead: float) -> OrbitSource:
    drifts = orbit_phase_of(device, ratio).drift != 0.0
    return orbit_source_of(orbit._replace(leads=orbit.leads.visited(lead)), device, drifts=drifts)
