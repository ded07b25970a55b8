"""The points of a sweep: products of axes, lists side by side, and random samples."""

from __future__ import annotations

import random
from collections.abc import Mapping, Sequence
from itertools import product
from math import exp, isfinite, log, prod
from typing import Any

from slider_resonator.errors import unknown_name

Points = tuple[tuple[str, ...], tuple[tuple[float, ...], ...]]
"""Names that are varied, and their values point by point."""

SPACINGS = ("linear", "log")
MAX_POINTS = 10_000_000
"""More would not fit into the memory of the process that writes the table."""


class AxisError(ValueError):
    """An invalid description of points; the message is shown to the user."""


def grid_points(table: Mapping[str, Any]) -> Points:
    """Return the product of the axes, each a list of values or from, to, count and spacing.

    The axis that is written last varies fastest.
    """
    axes = [_axis(f"grid.{name}", value) for name, value in table.items()]
    check_count(prod(map(len, axes)))
    return tuple(table), tuple(product(*axes)) if axes else ()


def list_points(table: Mapping[str, Any]) -> Points:
    """Return the points whose values stand side by side in lists of equal length."""
    columns = [_values(f"list.{name}", value) for name, value in table.items()]
    lengths = {name: len(column) for name, column in zip(table, columns, strict=True)}
    if len(set(lengths.values())) > 1:
        shown = ", ".join(f"{name} {length}" for name, length in lengths.items())
        raise AxisError(f"[list]: the lengths differ ({shown}); must be of equal length")
    return tuple(table), tuple(zip(*columns, strict=True))


def random_points(table: Mapping[str, Any]) -> Points:
    """Return `count` points from `seed`, each variable uniform in from..to, or in its logarithm.

    Python's own generator: the same points on every platform and with every version.
    """
    if not table:
        return (), ()
    numbers = {
        key: whole_number(f"random.{key}", table.get(key), minimum)
        for key, minimum in (("count", 1), ("seed", 0))
    }
    check_count(numbers["count"])
    ranges = {name: value for name, value in table.items() if name not in numbers}
    if not ranges:
        raise AxisError(
            "[random]: no variable; must have some, such as load = { from = 0, to = 0.05 }"
        )
    bounds = [_bounds(f"random.{name}", value, ()) for name, value in ranges.items()]
    generator = random.Random(numbers["seed"])
    rows = (
        tuple(_between(*bound, generator.random()) for bound in bounds)
        for _ in range(numbers["count"])
    )
    return tuple(ranges), tuple(rows)


def check_count(count: int) -> None:
    """Raise AxisError for more points than a sweep may have."""
    if count > MAX_POINTS:
        raise AxisError(f"{count} points; must be at most {MAX_POINTS}")


def _axis(key: str, value: object) -> Sequence[float]:
    if not isinstance(value, dict):
        return _values(key, value)
    first, last, spacing = _bounds(key, value, ("count",))
    count = whole_number(f"{key}.count", value.get("count"), 2)
    check_count(count)
    return [_between(first, last, spacing, index / (count - 1)) for index in range(count)]


def _values(key: str, value: object) -> Sequence[float]:
    if not isinstance(value, list) or not value:
        raise AxisError(f"{key} = {value!r}: must be a list of one number or more")
    for entry in value:
        finite_number(key, entry)
    return [float(entry) for entry in value]


def _bounds(key: str, value: object, more: Sequence[str]) -> tuple[float, float, str]:
    """Return from, to and spacing of a table that has these keys and those of `more`."""
    if not isinstance(value, dict):
        raise AxisError(f"{key} = {value!r}: must be a table with from and to")
    allowed = ("from", "to", "spacing", *more)
    for name in value:
        if name not in allowed:
            raise AxisError(f"{key}: {unknown_name('key', name, allowed)}")
    first, last = (finite_number(f"{key}.{name}", value.get(name)) for name in ("from", "to"))
    spacing = value.get("spacing", "linear")
    if spacing not in SPACINGS:
        raise AxisError(f"{key}.spacing = {spacing!r}: must be one of {', '.join(SPACINGS)}")
    if spacing == "log" and not (first > 0.0 and last > 0.0):
        raise AxisError(f"{key}: from {first!r} to {last!r}: must be above 0 for log")
    return first, last, spacing


def _between(first: float, last: float, spacing: str, share: float) -> float:
    """Return the value at a share of the way; the ends are met exactly."""
    if share in (0.0, 1.0):
        return first if share == 0.0 else last
    if spacing == "log":
        return exp(log(first) + (log(last) - log(first)) * share)
    return first + (last - first) * share


def whole_number(key: str, value: object, minimum: int) -> int:
    """Return a whole number of at least `minimum`; AxisError for anything else."""
    if isinstance(value, bool) or not isinstance(value, int) or value < minimum:
        raise AxisError(f"{_given(key, value)}: must be a whole number of at least {minimum}")
    return value


def finite_number(key: str, value: object) -> float:
    """Return a finite number; AxisError for anything else."""
    if isinstance(value, bool) or not isinstance(value, int | float) or not isfinite(value):
        raise AxisError(f"{_given(key, value)}: must be a finite number")
    return float(value)


def _given(key: str, value: object) -> str:
    return f"{key} is missing" if value is None else f"{key} = {value!r}"
