"""What a sweep computes, read from a TOML file: the points, the measures, and how to run them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import chain, product
from math import prod
from pathlib import Path
from typing import Any

from slider_resonator.device.common_period import MAX_DENOMINATOR
from slider_resonator.device.interface import SETTABLE
from slider_resonator.device.values import check_value
from slider_resonator.errors import HarnessError, unknown_name
from slider_resonator.scenes.device_file import device_values, refuse_other_kinds
from slider_resonator.scenes.toml_file import read_toml
from slider_resonator.sweeping.axes import (
    AxisError,
    check_count,
    finite_number,
    grid_points,
    list_points,
    random_points,
    whole_number,
)
from slider_resonator.sweeping.measures import Run, Task, check_measure

KEYS = ("title", "measures", "max_denominator", "device", "fixed", "grid", "list", "random", "run")
RUN_KEYS = ("drive_periods", "steps_per_period", "skip_periods")
RUN_DEFAULTS = {"drive_periods": 100, "steps_per_period": 16, "skip_periods": 0}


@dataclass(frozen=True)
class Sweep:
    """A valid sweep.

    `points` are the values of `task.names`, one tuple each, in the order of the rows of the table.
    `is_grid` says that they are a full product of axes and nothing else,
    `logarithmic` are the variables with that spacing.
    """

    title: str
    task: Task
    points: tuple[tuple[float, ...], ...]
    is_grid: bool
    logarithmic: frozenset[str] = frozenset()


def read_grid(path: Path, device: Mapping[str, float] | None = None) -> Sweep:
    """Read a grid file; raises HarnessError with file, key, value and requirement.

    `device` has parameters that its own [device], [fixed] and what varies leave out.
    """
    content = read_toml(path)
    refuse_other_kinds(content, str(path), "grid")
    return grid_from(content, str(path), device)


def grid_from(
    content: Mapping[str, Any], source: str, device: Mapping[str, float] | None = None
) -> Sweep:
    """Return the sweep of parsed TOML, or data of the same form; HarnessError with `source`."""
    try:
        _table(content, "device")
        return _sweep(content, {**(device or {}), **device_values(content, source)})
    except AxisError as error:
        raise HarnessError(f"{source}: {error}") from error


def _sweep(content: Mapping[str, Any], device: Mapping[str, float]) -> Sweep:
    _known("key", content, KEYS)
    parts = (
        grid_points(_table(content, "grid")),
        list_points(_table(content, "list")),
        random_points(_table(content, "random")),
    )
    names = [name for own, _ in parts for name in own]
    if not names:
        raise AxisError("nothing is varied; must have any of [grid], [list] and [random]")
    fixed = dict(_table(content, "fixed"))
    for name in [*names, *fixed]:
        if name not in SETTABLE:
            raise AxisError(unknown_name("parameter or input", name, SETTABLE))
        if [*names, *fixed].count(name) > 1:
            raise AxisError(f"{name} is given more than once; must be in one place")
    factors = [rows for own, rows in parts if own]
    check_count(prod(map(len, factors)))
    points = tuple(tuple(chain.from_iterable(rows)) for rows in product(*factors))
    for column, name in enumerate(names):
        _check(name, {point[column] for point in points})
    for name, value in fixed.items():
        _check(name, [value])
    for name, value in device.items():
        if name not in names:
            fixed.setdefault(name, value)
    task = Task(
        names=tuple(names),
        fixed=tuple((name, float(value)) for name, value in fixed.items()),
        measures=_measures(content),
        max_denominator=whole_number(
            "max_denominator", content.get("max_denominator", MAX_DENOMINATOR), 1
        ),
        run=_run(_table(content, "run")),
    )
    is_grid = not content.get("list") and not content.get("random")
    title = content.get("title", "")
    if not isinstance(title, str):
        raise AxisError(f"title = {title!r}: must be a text in quotes")
    return Sweep(title, task, points, is_grid, _logarithmic(content))


def _logarithmic(content: Mapping[str, Any]) -> frozenset[str]:
    axes = [*_table(content, "grid").items(), *_table(content, "random").items()]
    return frozenset(
        name for name, axis in axes if isinstance(axis, dict) and axis.get("spacing") == "log"
    )


def _measures(content: Mapping[str, Any]) -> tuple[str, ...]:
    names = content.get("measures", ["steady_velocity"])
    if not isinstance(names, list) or not names or len(set(map(str, names))) < len(names):
        raise AxisError(f"measures = {names!r}: must be a list of different measures")
    for name in names:
        check_measure(name)
    return tuple(names)


def _run(table: Mapping[str, Any]) -> Run:
    _known("key of [run]", table, RUN_KEYS)
    periods, steps, skipped = (
        whole_number(key, table.get(key, RUN_DEFAULTS[key]), minimum)
        for key, minimum in zip(RUN_KEYS, (1, 1, 0), strict=True)
    )
    if skipped >= periods:
        raise AxisError(
            f"run.skip_periods = {skipped}: must be a whole number below drive_periods = {periods}"
        )
    return Run(periods, steps, skipped)


def _check(name: str, values: Iterable[object]) -> None:
    for value in values:
        try:
            check_value(name, finite_number(name, value))
        except ValueError as error:
            raise AxisError(str(error)) from error


def _table(content: Mapping[str, Any], key: str) -> Mapping[str, Any]:
    table = content.get(key, {})
    if not isinstance(table, dict):
        raise AxisError(f"{key} = {table!r}: must be a table headed [{key}]")
    return table


def _known(kind: str, table: Iterable[str], allowed: Iterable[str]) -> None:
    for key in table:
        if key not in allowed:
            raise AxisError(unknown_name(kind, key, allowed))
