"""Shifts of time along a curve of orbits, measured where they are asked for."""

from __future__ import annotations

from math import floor, pi
from typing import NamedTuple, Protocol

from .orbit_defect import LAG_PHASES
from .orbit_panel import BASE_PANELS, place_between
from .orbit_shifts import NO_SHIFT, SHIFT_POINTS, ShiftPoint


class ShiftCurve(Protocol):
    """A curve of orbits with shifts."""

    middle: float
    reach: float

    def shift(self, index: int) -> ShiftPoint | None:
        """A point of shifts, measured where it is missing; None where that fails."""
        ...


class ShiftsThere(NamedTuple):
    """Shifts at a velocity, see ShiftPoint; the time by which the lag is `unsure` [s]."""

    lag: float
    of_turn: float
    added_mass: float
    swing: float
    unsure: float


class Gain(NamedTuple):
    """Times [s]: what is gained, and how unsure that is."""

    gained: float
    unsure: float


def shifts_at(curve: ShiftCurve, velocity: float, phase: float) -> ShiftsThere | None:
    """The shifts at a velocity [m/s], 0 beyond grazing.

    The lag is that at a part `phase`, 0 up to 1, of a period from drive phase 0 on. None where an
    orbit cannot be probed.
    """
    if place_between(curve.middle, curve.reach, velocity) < 0.0:
        return ShiftsThere(0.0, 0.0, 0.0, 0.0, 0.0)
    index, share = _between(curve, velocity)
    before, after = curve.shift(index), curve.shift(index + 1)
    if before is None or after is None:
        return None
    mean = NO_SHIFT.plus(1.0 - share, before).plus(share, after)
    parts = phase * LAG_PHASES
    part, rest = int(parts) % LAG_PHASES, parts - floor(parts)
    first, second = mean.lags[part], mean.lags[(part + 1) % LAG_PHASES]
    lag = first + rest * (second - first)
    unsure = mean.unsure * (abs(lag) + abs(mean.shown))
    return ShiftsThere(lag, mean.of_turn, mean.added_mass, mean.swing, unsure)


def gain_between(curve: ShiftCurve, start: float, end: float) -> Gain | None:
    """What is gained from one velocity [m/s] to another; None as above."""
    low, high = sorted((_between(curve, start), _between(curve, end)))
    gained = unsure = 0.0
    if low == high:
        return Gain(0.0, 0.0)
    for index in range(low[0], high[0] + 1):
        part = _gain_after(curve, index, high[1] if index == high[0] else 1.0)
        if part is None:
            return None
        gained, unsure = gained + part.gained, unsure + part.unsure
    before = _gain_after(curve, *low)
    if before is None:
        return None
    gained -= before.gained
    forward = _between(curve, start) == low
    return Gain(gained if forward else -gained, max(unsure - before.unsure, 0.0))


def _between(curve: ShiftCurve, velocity: float) -> tuple[int, float]:
    """The point before a velocity, up to the last but one, and the share of the next, 0 to 1."""
    place = place_between(curve.middle, curve.reach, velocity)
    if place < 0.0:
        place = 0.0 if velocity > curve.middle else BASE_PANELS
    at = place * SHIFT_POINTS / BASE_PANELS - 0.5
    before = int(min(max(at, 0.0), SHIFT_POINTS - 2.0))
    return before, min(max(at - before, 0.0), 1.0)


def _gain_after(curve: ShiftCurve, index: int, share: float) -> Gain | None:
    """What is gained from the point `index` on up to a share of the way to the next.

    The section changes in the middle, and with it what V is.
    """
    before, after = curve.shift(index), curve.shift(index + 1)
    if before is None or after is None:
        return None
    mean = before.gained + 0.5 * share * (after.gained - before.gained)
    part = share * mean * pi / SHIFT_POINTS
    shown = 0.0 if index + 1 == SHIFT_POINTS // 2 else share * (after.shown - before.shown)
    return Gain(part + shown, 0.5 * (before.unsure + after.unsure) * (abs(part) + abs(shown)))
